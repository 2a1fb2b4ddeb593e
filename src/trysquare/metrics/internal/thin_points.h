// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace trysquare {

/// One point per cubic voxel: the one nearest to the voxel's center, ties by coordinates; sorted by voxel. The result
/// does not depend on the order of the points.
/// @param voxel_m  Edge length [m]; 0: every point has a voxel of its own, they are just sorted.
std::vector<Eigen::Vector3d> one_per_voxel(PointsView points, double voxel_m);

/// At most `max_points` of the points, evenly spread in space: one per cubic voxel, the one nearest to the voxel's
/// center, with voxels as small as the number allows. All points when there are no more than that. The result does not
/// depend on the order of the points; it is sorted by voxel.
/// @param smallest_voxel_m  Voxels start at this edge length [m], > 0.
std::vector<Eigen::Vector3d> thin_points(PointsView points, double smallest_voxel_m, std::size_t max_points);

}  // namespace trysquare
