// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"

namespace trysquare::internal {

/// @throws InvalidArgument  unless both have equally many poses, at least one, all finite.
void validate_poses(const Trajectory& reference, const Trajectory& estimate);

}  // namespace trysquare::internal
