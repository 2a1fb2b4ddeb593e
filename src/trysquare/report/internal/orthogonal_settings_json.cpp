// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/orthogonal_settings_json.h"

#include "trysquare/report/internal/statistics_json.h"

namespace trysquare::internal {
namespace {

Json patch_settings_json(const PatchSubsetSettings& settings) {
  return {{"num_scans", settings.patches.num_scans},
          {"patch_radius", settings.patches.patch_radius},
          {"spacing", settings.patches.spacing},
          {"planarity_ratio", settings.patches.planarity_ratio},
          {"line_ratio", settings.patches.line_ratio},
          {"max_thickness", settings.patches.max_thickness},
          {"min_points", settings.patches.min_points},
          {"tolerance_deg", settings.triad.tolerance_rad * kDegreesPerRadian},
          {"max_offset_deg", settings.triad.max_offset_rad * kDegreesPerRadian},
          {"min_support", settings.triad.min_support},
          {"min_contrast", settings.triad.min_contrast},
          {"min_significance", settings.triad.min_significance},
          {"max_chance_of_pair", settings.triad.max_chance_of_pair},
          {"max_chance_of_triad", settings.triad.max_chance_of_triad}};
}

Json cluster_settings_json(const ClusterSubsetSettings& settings) {
  Json json = {{"num_scans", settings.num_scans},
               {"planarity_ratio", settings.planarity_ratio},
               {"linkage", settings.linkage == Linkage::kWard ? "ward" : "complete"},
               {"linkage_cut", settings.linkage_cut},
               {"orthogonality_bound", settings.orthogonality_bound},
               {"min_cluster_size", settings.min_cluster_size},
               {"join_colinear", settings.join_colinear}};
  if (settings.num_nearest) json["num_nearest"] = *settings.num_nearest;
  return json;
}

}  // namespace

Json orthogonal_settings_json(const OrthogonalSubsetSettings& settings) {
  Json json = {{"method", name_of(settings.method)}};
  json.update(settings.method == SubsetMethod::kPatches ? patch_settings_json(settings.for_patches())
                                                        : cluster_settings_json(settings.for_clusters()));
  return json;
}

}  // namespace trysquare::internal
