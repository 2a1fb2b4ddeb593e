// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/registered_map.h"
#include "trysquare/metrics/normal_clusters.h"
#include "trysquare/metrics/orthogonal_subset.h"

#include <cstddef>
#include <optional>
#include <string>

namespace trysquare {

/// How an orthogonal subset is made from clusters of normals. Defaults are the paper's; what it leaves open is as in
/// its code.
struct ClusterSubsetSettings {
  std::size_t num_scans = 1;             ///< Scans, evenly spread, whose points are looked at, all of them; >= 1.
  double planarity_ratio = 100;          ///< Planar: planarity_ratio · λ₁ < λ₂; > 0.
  Linkage linkage = Linkage::kComplete;  ///< Complete: normals have no sign. Ward: they have one.
  double linkage_cut = 0.1;              ///< Clusters merge while their distance is below; in (0, 1].
  double orthogonality_bound = 0.1;      ///< Orthogonal: |n·m| < bound; co-linear: |n·m| > 1 − bound; in (0, 1/3).
  std::size_t min_cluster_size = 6;      ///< Normals in a cluster that may become a direction; >= 1.
  bool join_colinear = true;             ///< Clusters co-linear with a direction join it, as the paper's graph intends.
  std::optional<std::size_t> num_nearest;  ///< Normals of so many nearest points, >= 3; empty: as planarity.

  void validate() const;  ///< @throws InvalidArgument
};

/// What map-metrics does: Ward on the signed normals of 30 nearest points, and one cluster a direction.
ClusterSubsetSettings map_metrics_subset_settings();

/// An orthogonal subset and what it was made from.
struct ClusterSubsetResult {
  OrthogonalSubset subset;       ///< 0 to 3 directions, largest clusters first.
  std::string reason;            ///< Why there are fewer than three; empty otherwise.
  std::size_t num_points = 0;    ///< Points looked at.
  std::size_t num_planar = 0;    ///< Of these, planar.
  std::size_t num_clusters = 0;  ///< Clusters of at least min_cluster_size normals.
};

/// Finds up to three mutually orthogonal directions the paper's way: planar points, clusters of their normals, and the
/// largest clique of orthogonal clusters.
///
/// Neighborhoods are within one scan. With complete linkage the result does not depend on the order of the points
/// within a scan.
///
/// @param map       N points in scan order, map frame [m].
/// @param radius_m  Of the neighborhoods that give planarity, and normals unless num_nearest is set, > 0 [m].
/// @return          Fewer than three directions are a result, not an error: `reason` says why.
/// @throws InvalidArgument  if `settings` or `radius_m` is out of range, or a coordinate is not finite.
///
/// Source:  Kornilova & Ferrer, "Be your own Benchmark", §IV-B; map-metrics 0.0.4.
/// Differs: docs/definitions.md#orthogonal-subset.
/// Cost:    that of cluster_normals(); a KITTI scan of 124,668 points takes half a second and 24 MB beside the points.
ClusterSubsetResult cluster_subset(const RegisteredMap& map, double radius_m,
                                   const ClusterSubsetSettings& settings = {}, const Execution& execution = {});

}  // namespace trysquare
