// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"

#include <Eigen/Core>

#include <vector>

namespace trysquare {

/// One point per cubic voxel: the one nearest to the voxel's center, ties by coordinates; sorted by voxel. The result
/// does not depend on the order of the points.
/// @param voxel_m  Edge length [m]; 0: every point has a voxel of its own, they are just sorted.
std::vector<Eigen::Vector3d> one_per_voxel(PointsView points, double voxel_m);

}  // namespace trysquare
