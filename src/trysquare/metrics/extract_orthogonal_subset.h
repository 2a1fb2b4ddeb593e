// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/registered_map.h"
#include "trysquare/metrics/orthogonal_subset.h"

#include <cstddef>
#include <string>

namespace trysquare {

/// How orthogonal surfaces are found. Paper §IV-B; values that the paper leaves open are those of its code.
struct OrthogonalSubsetSettings {
  double planarity_ratio = 100;      ///< Planar: planarity_ratio · λ₁ < λ₂; > 0.
  double linkage_cut = 0.1;          ///< Clusters merge while their complete-linkage distance is below; in (0, 1].
  double orthogonality_bound = 0.1;  ///< Orthogonal: |n·m| < bound; co-linear: |n·m| > 1 − bound; in (0, 1/3).
  std::size_t min_cluster_size = 6;  ///< Normals in a cluster that may become a direction; >= 1.
  std::size_t num_scans = 5;         ///< Scans, evenly spread, whose points are looked at; >= 1.
  std::size_t max_points = 6000;     ///< The scans' points are thinned, evenly in space, to at most this many; >= 1.
  bool join_colinear = true;         ///< Clusters co-linear with a direction join it, as the paper's graph intends.

  void validate() const;  ///< @throws InvalidArgument
};

/// An orthogonal subset and what it was made from.
struct OrthogonalSubsetResult {
  OrthogonalSubset subset;       ///< 0 to 3 directions, largest first.
  std::string reason;            ///< Why there are fewer than three; empty otherwise.
  std::size_t num_points = 0;    ///< Points looked at.
  std::size_t num_planar = 0;    ///< Points of them that are planar.
  std::size_t num_clusters = 0;  ///< Clusters of at least min_cluster_size normals.
};

/// Finds up to three mutually orthogonal directions and the planar points that face them.
///
/// Normals and planarity come from neighborhoods within one scan, so pose errors do not decide what counts as a plane.
/// Normals carry no sign: n and −n are one. The result does not depend on the order of the points within a scan.
///
/// @param map       N points, map frame [m], with the scan of each.
/// @param radius_m  Of the neighborhoods that give normals and planarity, > 0 [m].
/// @return          Fewer than three directions are a result, not an error: `reason` says why.
/// @throws InvalidArgument  if `settings` or `radius_m` is out of range.
///
/// Source:  Kornilova & Ferrer, "Be your own Benchmark", §IV-B: planar points, complete linkage, maximum clique.
/// Differs: docs/definitions.md#orthogonal-subset.
/// Cost:    Memory linear in the points; the clustering is that of cluster_normals for at most max_points normals.
OrthogonalSubsetResult extract_orthogonal_subset(const RegisteredMap& map, double radius_m,
                                                 const OrthogonalSubsetSettings& settings = {},
                                                 const Execution& execution = {});

}  // namespace trysquare
