// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/registered_map.h"
#include "trysquare/metrics/metric_result.h"
#include "trysquare/metrics/orthogonal_metric_result.h"
#include "trysquare/metrics/orthogonal_subset.h"
#include "trysquare/metrics/overlap.h"
#include "trysquare/metrics/point_statistics.h"
#include "trysquare/pipeline/evaluation_settings.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// Every metric of one map, and the point values that they summarise.
struct MapMetrics {
  MetricResult mpv;  ///< A metric that was not asked for has no value and the reason "not asked for"; so below.
  MetricResult mme;
  OrthogonalMetricResult mom;
  OrthogonalMetricResult omme;
  Overlap overlap;
  std::vector<std::size_t> query_indices;  ///< Map points that were queries.
  PointStatistics query_statistics;        ///< In the order of query_indices.
  OrthogonalSubset subset;                 ///< Extracted or as given; empty when neither MOM nor OMME was asked for.
  std::string subset_reason;               ///< Why it has fewer than three directions; empty otherwise.
};

/// The metrics of one map: of the whole sequence or of a window.
/// @param subset  Map frame; empty: extracted from the map.
/// @throws InvalidArgument  if `settings` is out of range.
MapMetrics map_metrics(const RegisteredMap& map, const std::optional<OrthogonalSubset>& subset,
                       const EvaluationSettings& settings, const Execution& execution = {});

}  // namespace trysquare
