// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/points.h"
#include "trysquare/neighborhood/moments.h"
#include "trysquare/neighborhood/point_index.h"

#include <cstddef>
#include <functional>
#include <span>

namespace trysquare {

/// How the vicinity W(p) of a point is chosen: all map points with d < radius (strictly). Paper §III-B.
struct NeighborhoodSettings {
  double radius_m = 1.0;  ///< > 0 and finite [m].
  int min_neighbors = 6;  ///< Fewer points than this (query included) leave the point's value undefined; >= 3.

  void validate() const;  ///< @throws InvalidArgument
};

/// The moments of some consecutive queries: moments[i] belongs to query `first_query + i`.
struct NeighborhoodBlock {
  std::size_t first_query = 0;
  std::span<const Moments> moments;
};

/// Visits the moments of the neighborhood of every query point, block by block.
///
/// Nothing of the size queries × Moments is ever stored. Blocks are fixed: they do not depend on the number of threads.
///
/// @param map             Index over the registered map: N points, map frame [m].
/// @param queries_in_map  M points, map frame [m]; they need not be points of the map.
/// @param settings        radius_m decides what is visited. min_neighbors is the business of the visitor.
/// @param execution       Threads. What is visited is bit-identical for every value.
/// @param visit           Called once a block, from several threads at once, on distinct blocks, in no fixed order.
/// @throws InvalidArgument  if `settings` is out of range or a query is not finite.
///
/// Source: paper §III-B. Cost: O(M·(log N + k)) for k neighbors each; O(1) memory a thread.
void for_each_neighborhood(const PointIndex& map, PointsView queries_in_map, const NeighborhoodSettings& settings,
                           const Execution& execution, const std::function<void(const NeighborhoodBlock&)>& visit);

}  // namespace trysquare
