// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"

#include <vector>

namespace trysquare::internal {

/// Distance of two positions [m], its squares added from left to right, as numpy does: a path that reaches a length
/// exactly must not miss it by one rounding.
double step_length(const Pose& a, const Pose& b);

/// How far along its path each pose is [m]; the first is 0.
std::vector<double> path_lengths(const Trajectory& trajectory);

}  // namespace trysquare::internal
