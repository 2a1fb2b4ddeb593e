// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/points.h"
#include "trysquare/metrics/definition.h"
#include "trysquare/neighborhood/for_each_neighborhood.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trysquare {

/// How many query points have a value, and why the others have none.
struct PointSupport {
  std::size_t num_defined = 0;     ///< Enough neighbors and not degenerate.
  std::size_t num_degenerate = 0;  ///< Enough neighbors, but they lie exactly in a plane: λ₁ <= 1e-12 λ₃.
  std::size_t num_too_few = 0;     ///< Not enough neighbors.
};

/// What the metrics need to know of every query point; M entries each, in query order. One pass over the
/// neighborhoods fills them, and MME, MPV, MOM, OMME and the overlap are summaries of them.
struct PointStatistics {
  std::vector<double> plane_variances;       ///< v(p) = λ₁ [m²]; NaN with too few neighbors, 0 where degenerate.
  std::vector<double> entropies;             ///< h(p) [nats]; NaN with too few neighbors and where degenerate.
  std::vector<std::uint32_t> num_neighbors;  ///< Points in W(p).
  std::vector<std::uint32_t> num_scans;      ///< Distinct scans among them; 0 when the map carries no scan identity.
  PointSupport plane_variance_support;
  PointSupport entropy_support;   ///< Differs from the other for kMapEval and kAisBonn, which count differently.
  std::size_t num_line_like = 0;  ///< Enough neighbors, but λ₂ <= 0.01 λ₃: ten times longer than wide.

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

/// The same of moments that are at hand: of M queries, in their order. radius_m does not matter then.
PointStatistics point_statistics(std::span<const Moments> moments, const NeighborhoodSettings& settings,
                                 Definition definition = Definition::kPaper);

}  // namespace trysquare
