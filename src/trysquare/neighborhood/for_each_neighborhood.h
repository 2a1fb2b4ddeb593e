// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/points.h"
#include "trysquare/neighborhood/moments.h"
#include "trysquare/neighborhood/point_index.h"

#include <cstdint>
#include <functional>
#include <span>

namespace trysquare {

/// How the vicinity W(p) of a point is chosen: all map points with d < radius (strictly). Paper §III-B.
struct NeighborhoodSettings {
  double radius_m = 1.0;  ///< > 0 and finite [m].
  int min_neighbors = 6;  ///< Fewer points than this (query included) leave the point's value undefined; >= 3.

  void validate() const;  ///< @throws InvalidArgument
};

/// The moments of some queries that lie near each other: moments[i] belongs to queries_in_map[queries[i]].
struct NeighborhoodBlock {
  std::span<const std::uint32_t> queries;
  std::span<const Moments> moments;
};

/// Visits the moments of the neighborhood of every query point, block by block.
///
/// Nothing of the size queries × Moments is ever stored. Blocks are fixed: they do not depend on the number of threads.
/// Exact: a point is in W(p) if (dx² + dy²) + dz² < radius² in double precision, in this order, and only then.
///
/// @param map             Index over the registered map: N points, map frame [m].
/// @param queries_in_map  M points, map frame [m]; they need not be points of the map. When they are the very span from
///                        which the index was made, they are not sorted again.
/// @param settings        radius_m decides what is visited. min_neighbors is the business of the visitor.
/// @param execution       Threads. What is visited is bit-identical for every value.
/// @param visit           Called once a block, from several threads at once, on distinct blocks, in no fixed order.
/// @throws InvalidArgument  if `settings` is out of range, a query is not finite or beyond 1e150 m, or there are too
///                          many: 2³² − 1 or more.
///
/// Accuracy: |Δλ₁| <= 1e-12 λ₃ for the eigenvalues of every covariance, against long double, up to 1e8 m from the map's
///           origin.
/// Source: paper §III-B; docs/decisions/0012-neighborhood-engine.md.
/// Cost: about O(M·√k) for k neighbors each, when the queries are as dense as the map; 0.3 MB a thread, and 30 bytes a
/// query when these are not the points of the index.
void for_each_neighborhood(const PointIndex& map, PointsView queries_in_map, const NeighborhoodSettings& settings,
                           const Execution& execution, const std::function<void(const NeighborhoodBlock&)>& visit);

}  // namespace trysquare
