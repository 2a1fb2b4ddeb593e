// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/pose.h"
#include "trysquare/core/trajectory.h"

#include <Eigen/Core>

#include <vector>

namespace trysquare {

/// From a left-handed convention (CARLA, Unreal: x forward, y right, z up) to the right-handed one with the same x and
/// z (x forward, y left, z up): y changes its sign in every frame, so points p become S·p and poses T become S·T·S,
/// with S = diag(1, −1, 1). Exact: only signs change. Each is its own inverse.
Pose with_y_negated(const Pose& b_from_a);
Trajectory with_y_negated(Trajectory trajectory);
void negate_y(std::vector<Eigen::Vector3d>& points);

}  // namespace trysquare
