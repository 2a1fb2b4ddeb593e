// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/extract_orthogonal_subset.h"

#include "trysquare/metrics/internal/scans_of_map.h"

#include <array>
#include <utility>

namespace trysquare {
namespace {

constexpr std::array<std::pair<SubsetMethod, std::string_view>, 3> kNames = {
    {{SubsetMethod::kPatches, "patches"}, {SubsetMethod::kPaper, "paper"}, {SubsetMethod::kMapMetrics, "map-metrics"}}};

OrthogonalSubsetResult from_patches(const RegisteredMap& map, double radius_m, const PatchSubsetSettings& settings,
                                    const Execution& execution) {
  PatchSubsetResult result = patch_subset(map, radius_m, settings, execution);
  return {.subset = std::move(result.subset),
          .reason = std::move(result.reason),
          .num_points = result.num_candidates,
          .num_planar = result.num_planar,
          .num_clusters = result.num_modes};
}

OrthogonalSubsetResult from_clusters(const RegisteredMap& map, double radius_m, const ClusterSubsetSettings& settings,
                                     const Execution& execution) {
  ClusterSubsetResult result = cluster_subset(map, radius_m, settings, execution);
  return {.subset = std::move(result.subset),
          .reason = std::move(result.reason),
          .num_points = result.num_points,
          .num_planar = result.num_planar,
          .num_clusters = result.num_clusters};
}

}  // namespace

std::string_view name_of(SubsetMethod method) {
  for (const auto& [known, name] : kNames) {
    if (known == method) return name;
  }
  return "";
}

std::optional<SubsetMethod> subset_method_named(std::string_view name) {
  for (const auto& [method, known] : kNames) {
    if (known == name) return method;
  }
  return std::nullopt;
}

PatchSubsetSettings OrthogonalSubsetSettings::for_patches() const {
  PatchSubsetSettings settings;
  if (num_scans) settings.patches.num_scans = *num_scans;
  return settings;
}

ClusterSubsetSettings OrthogonalSubsetSettings::for_clusters() const {
  ClusterSubsetSettings settings;
  if (method == SubsetMethod::kMapMetrics) {
    settings = map_metrics_subset_settings();
  } else {
    settings.join_colinear = join_colinear;
  }
  if (num_scans) settings.num_scans = *num_scans;
  return settings;
}

std::vector<std::uint32_t> OrthogonalSubsetSettings::scans_looked_at(std::size_t num_scans_of_map) const {
  const std::size_t wanted =
      method == SubsetMethod::kPatches ? for_patches().patches.num_scans : for_clusters().num_scans;
  return evenly_spread_scans(num_scans_of_map, wanted);
}

void OrthogonalSubsetSettings::validate() const {
  if (method == SubsetMethod::kPatches) {
    for_patches().validate();
  } else {
    for_clusters().validate();
  }
}

std::optional<double> OrthogonalSubsetResult::planar_share() const {
  if (num_points == 0) return std::nullopt;
  return static_cast<double>(num_planar) / static_cast<double>(num_points);
}

OrthogonalSubsetResult extract_orthogonal_subset(const RegisteredMap& map, double radius_m,
                                                 const OrthogonalSubsetSettings& settings, const Execution& execution) {
  if (settings.method == SubsetMethod::kPatches) {
    return from_patches(map, radius_m, settings.for_patches(), execution);
  }
  return from_clusters(map, radius_m, settings.for_clusters(), execution);
}

}  // namespace trysquare
