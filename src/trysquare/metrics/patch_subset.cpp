// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/patch_subset.h"

#include <fmt/format.h>

#include <utility>

namespace trysquare {
namespace {

std::string why_incomplete(const PatchSubsetResult& result) {
  if (result.num_patches == 0) return fmt::format("none of {} points lies on a planar patch", result.num_candidates);
  if (result.directions.empty())
    return fmt::format("no direction stands out among the normals of {} planar patches", result.num_patches);
  return fmt::format("only {} of 3 mutually orthogonal directions found in {} planar patches", result.directions.size(),
                     result.num_patches);
}

OrthogonalSubset subset_of(const std::vector<PlanarPatch>& patches, const OrthogonalTriad& triad) {
  OrthogonalSubset subset;
  for (const TriadDirection& direction : triad.directions) {
    subset.directions.push_back({.normal_in_map = direction.axis, .points_in_map = {}});
  }
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const std::uint8_t direction = triad.direction_of_normal[i];
    if (direction != kNoDirection) subset.directions[direction].points_in_map.push_back(patches[i].center_in_map);
  }
  return subset;
}

}  // namespace

void PatchSubsetSettings::validate() const {
  patches.validate();
  triad.validate();
}

std::optional<double> PatchSubsetResult::planar_share() const {
  if (num_candidates == 0) return std::nullopt;
  return static_cast<double>(num_planar) / static_cast<double>(num_candidates);
}

PatchSubsetResult patch_subset(const RegisteredMap& map, double radius_m, const PatchSubsetSettings& settings,
                               const Execution& execution) {
  settings.validate();
  const PlanarPatches found = planar_patches(map, radius_m, settings.patches, execution);  // step 1: planar patches
  std::vector<Eigen::Vector3d> normals;
  for (const PlanarPatch& patch : found.patches) normals.push_back(patch.normal_in_map);
  OrthogonalTriad triad = orthogonal_triad(normals, settings.triad);   // step 2: directions that their normals share
  PatchSubsetResult result{.subset = subset_of(found.patches, triad),  // step 3: the patches that face them
                           .directions = std::move(triad.directions),
                           .chance = triad.chance,
                           .num_candidates = found.num_candidates,
                           .num_planar = found.num_planar,
                           .num_patches = found.patches.size(),
                           .num_modes = triad.num_modes};
  if (result.directions.size() < 3) result.reason = why_incomplete(result);
  return result;
}

}  // namespace trysquare
