// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/orthogonal_statistics.h"

namespace trysquare {

OrthogonalStatistics orthogonal_statistics(const PointIndex& map, const OrthogonalSubset& subset,
                                           const NeighborhoodSettings& settings, const Execution& execution) {
  settings.validate();
  OrthogonalStatistics result;
  for (const OrthogonalSubset::Direction& direction : subset.directions) {
    result.directions.push_back({direction.normal_in_map, point_statistics(map, direction.points_in_map, settings,
                                                                           Definition::kPaper, execution)});
  }
  return result;
}

}  // namespace trysquare
