// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/points.h"
#include "trysquare/metrics/definition.h"
#include "trysquare/neighborhood/for_each_neighborhood.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trysquare {

/// What the metrics need to know of every query point; M entries each, in query order. One pass over the
/// neighborhoods fills them, and MME, MPV, MOM, OMME and the overlap are summaries of them.
struct PointStatistics {
  std::vector<double> plane_variances;  ///< v(p) = λ₁ [m²]; NaN where undefined, 0 where degenerate.
  std::vector<double> entropies;        ///< h(p) [nats]; NaN where undefined or degenerate.
  std::vector<std::uint32_t> num_neighbors;
  std::vector<std::uint32_t> num_scans;  ///< Distinct scans in the neighborhood.
  std::vector<std::uint8_t> is_degenerate;  ///< 1: enough neighbors, but λ₁ <= 1e-12 λ₃.
  std::vector<std::uint8_t> is_line_like;   ///< 1: enough neighbors, but λ₂ <= 0.01 λ₃: ten times longer than wide.
  std::size_t num_too_few_for_entropy = 0;  ///< Differs from the NaNs of plane_variances for kMapEval and kAisBonn.

  std::size_t size() const { return plane_variances.size(); }
};

/// Plane variance and entropy of every query point.
///
/// @param map             Index over the registered map: N points, map frame [m].
/// @param queries_in_map  M points, map frame [m].
/// @param settings        Points with fewer than min_neighbors are undefined.
/// @param definition      Decides the entropy only; plane variances are the same for all.
/// @throws InvalidArgument  if `settings` is out of range. Undefined points are results, not errors.
///
/// Source: paper §III-B: v(p) = λ_min(Σ(p)), h(p) = ½ ln det(2πe Σ(p)); docs/definitions.md#mme.
PointStatistics point_statistics(const PointIndex& map, PointsView queries_in_map, const NeighborhoodSettings& settings,
                                 Definition definition = Definition::kPaper, const Execution& execution = {});

}  // namespace trysquare
