// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/registered_map.h"
#include "trysquare/metrics/cluster_subset.h"
#include "trysquare/metrics/orthogonal_subset.h"
#include "trysquare/metrics/patch_subset.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trysquare {

/// How orthogonal surfaces are found.
enum class SubsetMethod {
  kPatches,     ///< patch_subset(): planar patches of several scans and the triad that stands out. The default.
  kPaper,       ///< cluster_subset(): complete linkage of normals without sign.
  kMapMetrics,  ///< cluster_subset() as map-metrics: Ward on signed normals of 30 nearest points.
};

/// "patches", "paper", "map-metrics".
std::string_view name_of(SubsetMethod method);

/// The method that name_of() calls `name`; nullopt when there is none.
std::optional<SubsetMethod> subset_method_named(std::string_view name);

/// The method, and the settings of the one that is chosen.
struct OrthogonalSubsetSettings {
  SubsetMethod method = SubsetMethod::kPatches;
  std::optional<std::size_t> num_scans;  ///< Scans, evenly spread, that are looked at; empty: the method's own.
  bool join_colinear = true;             ///< kPaper: clusters co-linear with a direction join it.

  /// What the methods are called with.
  PatchSubsetSettings for_patches() const;
  ClusterSubsetSettings for_clusters() const;  ///< Of kPaper or kMapMetrics.

  /// Which scans of a map are looked at: a map of these alone gives the same.
  std::vector<std::uint32_t> scans_looked_at(std::size_t num_scans_of_map) const;

  void validate() const;  ///< @throws InvalidArgument
};

/// An orthogonal subset and what it was made from, by any method.
struct OrthogonalSubsetResult {
  OrthogonalSubset subset;       ///< 0 to 3 directions, largest first.
  std::string reason;            ///< Why there are fewer than three; empty otherwise.
  std::size_t num_points = 0;    ///< Points looked at.
  std::size_t num_planar = 0;    ///< Of these, on a plane.
  std::size_t num_clusters = 0;  ///< Groups of normals from which directions were chosen: large clusters, or modes.

  /// num_planar / num_points; nullopt when no point was looked at.
  std::optional<double> planar_share() const;
};

/// Finds up to three mutually orthogonal directions and the planar points that face them, by the method of choice.
///
/// @param map       N points in scan order, map frame [m], with the scan of each.
/// @param radius_m  Of the metrics' neighborhoods, > 0 [m].
/// @return          Fewer than three directions are a result, not an error: `reason` says why.
/// @throws InvalidArgument  if `settings` or `radius_m` is out of range.
///
/// Source: Kornilova & Ferrer, "Be your own Benchmark", §IV-B; docs/definitions.md#orthogonal-subset.
OrthogonalSubsetResult extract_orthogonal_subset(const RegisteredMap& map, double radius_m,
                                                 const OrthogonalSubsetSettings& settings = {},
                                                 const Execution& execution = {});

}  // namespace trysquare
