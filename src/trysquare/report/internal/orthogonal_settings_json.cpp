// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/orthogonal_settings_json.h"

namespace trysquare::internal {

Json orthogonal_settings_json(const OrthogonalSubsetSettings& settings) {
  return {{"planarity_ratio", settings.planarity_ratio},
          {"linkage_cut", settings.linkage_cut},
          {"orthogonality_bound", settings.orthogonality_bound},
          {"min_cluster_size", settings.min_cluster_size},
          {"num_scans", settings.num_scans},
          {"max_points", settings.max_points},
          {"join_colinear", settings.join_colinear}};
}

}  // namespace trysquare::internal
