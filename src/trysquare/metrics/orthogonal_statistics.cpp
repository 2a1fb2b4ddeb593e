// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/orthogonal_statistics.h"

#include <span>
#include <vector>

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

OrthogonalStatistics orthogonal_statistics(std::size_t num_scans, const PointsOfScan& points_of_scan,
                                           const OrthogonalSubset& subset, const NeighborhoodSettings& settings,
                                           const Execution& execution) {
  std::vector<Eigen::Vector3d> queries;  // of all directions, so that every scan is read once
  for (const OrthogonalSubset::Direction& direction : subset.directions) {
    queries.insert(queries.end(), direction.points_in_map.begin(), direction.points_in_map.end());
  }
  std::vector<Moments> moments(queries.size());
  stream_neighborhoods(num_scans, points_of_scan, queries, settings, execution, [&](const NeighborhoodBlock& block) {
    for (std::size_t i = 0; i < block.queries.size(); ++i) moments[block.queries[i]] = block.moments[i];
  });
  OrthogonalStatistics result;
  std::span<const Moments> rest = moments;
  for (const OrthogonalSubset::Direction& direction : subset.directions) {
    const std::size_t count = direction.points_in_map.size();
    result.directions.push_back({direction.normal_in_map, point_statistics(rest.first(count), settings)});
    rest = rest.subspan(count);
  }
  return result;
}

}  // namespace trysquare
