// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/map_metrics.h"

#include "trysquare/metrics/extract_orthogonal_subset.h"
#include "trysquare/metrics/mme.h"
#include "trysquare/metrics/mom.h"
#include "trysquare/metrics/mpv.h"
#include "trysquare/metrics/omme.h"
#include "trysquare/metrics/orthogonal_statistics.h"

#include <algorithm>
#include <utility>

namespace trysquare {
namespace {

constexpr const char* kNotAskedFor = "not asked for";

/// When neither MME nor MPV is asked for, the overlap alone needs no more queries than this.
constexpr std::size_t kQueriesOfOverlap = 20'000;

std::vector<std::size_t> choose_queries(std::size_t num_points, const EvaluationSettings& settings) {
  std::size_t every = settings.query_every;
  if (!settings.wants(Metric::kMme) && !settings.wants(Metric::kMpv)) {
    every = std::max(every, num_points / kQueriesOfOverlap);
  }
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < num_points; i += every) indices.push_back(i);
  return indices;
}

std::vector<Eigen::Vector3d> points_at(const std::vector<std::size_t>& indices, PointsView points) {
  std::vector<Eigen::Vector3d> chosen;
  chosen.reserve(indices.size());
  for (const std::size_t index : indices) chosen.push_back(points[index]);
  return chosen;
}

}  // namespace

MapMetrics map_metrics(const RegisteredMap& map, const std::optional<OrthogonalSubset>& subset,
                       const EvaluationSettings& settings, const Execution& execution) {
  settings.validate();
  MapMetrics result;
  const PointIndex index(map, {.num_threads = execution.num_threads});
  result.query_indices = choose_queries(map.points_in_map.size(), settings);
  const bool every_point = result.query_indices.size() == map.points_in_map.size();
  const std::vector<Eigen::Vector3d> chosen =
      every_point ? std::vector<Eigen::Vector3d>() : points_at(result.query_indices, map.points_in_map);
  result.query_statistics = point_statistics(index, every_point ? PointsView(map.points_in_map) : PointsView(chosen),
                                             {.radius_m = settings.radius_m, .min_neighbors = settings.min_neighbors},
                                             settings.definition, execution);
  result.overlap = overlap(result.query_statistics);
  result.mpv = settings.wants(Metric::kMpv) ? mpv(result.query_statistics) : MetricResult{.reason = kNotAskedFor};
  result.mme = settings.wants(Metric::kMme) ? mme(result.query_statistics, settings.definition)
                                            : MetricResult{.reason = kNotAskedFor};

  result.mom.reason = kNotAskedFor;
  result.omme.reason = kNotAskedFor;
  if (!settings.wants(Metric::kMom) && !settings.wants(Metric::kOmme)) return result;
  if (subset) {
    result.subset = *subset;
    if (subset->directions.size() < 3) result.subset_reason = "the given subset has fewer than three directions";
  } else {
    OrthogonalSubsetResult extracted =
        extract_orthogonal_subset(map, settings.radius_m, settings.orthogonal, {.num_threads = execution.num_threads});
    result.subset = std::move(extracted.subset);
    result.subset_reason = std::move(extracted.reason);
  }
  const OrthogonalStatistics statistics = orthogonal_statistics(
      index, result.subset, {.radius_m = settings.radius_m, .min_neighbors = settings.min_neighbors_orthogonal},
      {.num_threads = execution.num_threads});
  if (settings.wants(Metric::kMom)) result.mom = mom(statistics, settings.definition);
  if (settings.wants(Metric::kOmme)) result.omme = omme(statistics, settings.definition);
  if (result.subset.directions.empty()) {
    for (OrthogonalMetricResult* metric : {&result.mom, &result.omme}) {
      if (metric->reason != kNotAskedFor) metric->reason = result.subset_reason;
    }
  }
  return result;
}

}  // namespace trysquare
