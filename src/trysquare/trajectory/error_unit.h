// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/trajectory/trajectory_errors.h"

#include <string_view>

namespace trysquare {

/// The unit that the errors are in: `errors.unit`, or that of their relation.
std::string_view unit_of(const TrajectoryErrors& errors);

/// Errors and statistics in another unit of the same kind: mm, cm, m, km; deg, rad.
/// @throws InvalidArgument  if the unit is unknown, or not of the kind that the errors have; others cannot be changed.
void change_unit(TrajectoryErrors& errors, std::string_view unit);

}  // namespace trysquare
