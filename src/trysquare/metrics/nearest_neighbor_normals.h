// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/points.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace trysquare {

/// Normals as the paper's code takes them from Open3D ("hybrid search"): of the covariance of the nearest points.
///
/// @param scan         N points, any frame [m].
/// @param queries      M points, same frame [m].
/// @param radius_m     Only points nearer than this count, > 0 [m].
/// @param max_nearest  At most so many of them, the query included when it is a point of the scan; >= 3.
/// @return             M unit vectors, the eigenvectors of the smallest eigenvalues; NaN where fewer than three points
///                     are near. Open3D leaves the sign to rounding; here the largest component is positive.
/// @throws InvalidArgument  if an argument is out of range.
///
/// Which of several points at the same distance is the last to count is left to the search.
/// Source: map-metrics 0.0.4, which estimates normals with Open3D; docs/definitions.md#orthogonal-subset.
/// Cost:   O((N + M) log N).
std::vector<Eigen::Vector3d> nearest_neighbor_normals(PointsView scan, PointsView queries, double radius_m,
                                                      std::size_t max_nearest, const Execution& execution = {});

}  // namespace trysquare
