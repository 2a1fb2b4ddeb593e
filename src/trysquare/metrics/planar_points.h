// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/points.h"
#include "trysquare/neighborhood/for_each_neighborhood.h"

#include <Eigen/Core>

#include <vector>

namespace trysquare {

/// Points whose neighborhood is flat, with its normal; both arrays have the same length.
struct PlanarPoints {
  std::vector<Eigen::Vector3d> points;   ///< [m]
  std::vector<Eigen::Vector3d> normals;  ///< Unit length, sign arbitrary.
};

/// Keeps the queries with planarity_ratio · λ₁ < λ₂ and at least min_neighbors points around them that are no exact
/// line: λ₂ > 1e-12 λ₃.
///
/// @param scan      Index over the points that decide, any frame [m].
/// @param queries   Points that are tested, same frame [m].
/// @param settings  Neighborhood for normals and planarity: one radius for both.
/// @return          In the order of the queries.
/// Source: map-metrics' filter (the paper does not say); docs/definitions.md#orthogonal-subset.
PlanarPoints planar_points(const PointIndex& scan, PointsView queries, const NeighborhoodSettings& settings,
                           double planarity_ratio, const Execution& execution = {});

}  // namespace trysquare
