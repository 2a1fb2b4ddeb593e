// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/omme.h"

#include "trysquare/stats/mean.h"
#include "trysquare/stats/median.h"

#include <utility>
#include <vector>

namespace trysquare {

OrthogonalMetricResult omme(const OrthogonalStatistics& subset, Definition definition) {
  std::vector<OrthogonalMetricResult::Direction> directions;
  for (const OrthogonalStatistics::Direction& direction : subset.directions) {  // step 1: one orthogonal direction
    const PointStatistics& points = direction.points;
    directions.push_back({.normal_in_map = direction.normal_in_map,
                          .num_points = points.size(),
                          .num_used = points.entropy_support.num_defined,
                          .num_degenerate = points.entropy_support.num_degenerate,
                          .num_too_few = points.entropy_support.num_too_few,
                          .mean = mean_of_defined(points.entropies),  // step 2: its entropy
                          .median = median_of_defined(points.entropies)});
  }
  return combine_directions(std::move(directions), definition);  // step 3: the average of the directions
}

}  // namespace trysquare
