// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/orthogonal_metric_result.h"

#include <utility>

namespace trysquare {

OrthogonalMetricResult combine_directions(std::vector<OrthogonalMetricResult::Direction> directions,
                                          Definition definition) {
  OrthogonalMetricResult result{.directions = std::move(directions)};
  double sum_of_means = 0;
  double sum_of_medians = 0;
  std::size_t num_defined = 0;
  for (const OrthogonalMetricResult::Direction& direction : result.directions) {
    if (!direction.mean || !direction.median) continue;
    sum_of_means += *direction.mean;
    sum_of_medians += *direction.median;
    ++num_defined;
  }
  if (num_defined == 0) {
    result.reason = result.directions.empty() ? "there are no orthogonal directions"
                                              : "no point of any orthogonal direction has enough neighbors";
    return result;
  }
  result.mean_of_means = sum_of_means / static_cast<double>(num_defined);
  result.sum_of_medians = sum_of_medians;
  result.value = definition == Definition::kMapMetrics ? result.sum_of_medians : result.mean_of_means;
  result.follows_trajectory_error = num_defined == 3;
  return result;
}

}  // namespace trysquare
