// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/evaluation_settings.h"

#include "trysquare/core/error.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/neighborhood/for_each_neighborhood.h"

#include <fmt/format.h>

#include <algorithm>

namespace trysquare {

std::string_view name_of(Metric metric) {
  switch (metric) {
    case Metric::kMme:
      return "mme";
    case Metric::kMpv:
      return "mpv";
    case Metric::kOmme:
      return "omme";
    case Metric::kMom:
      return "mom";
    case Metric::kRpe:
      return "rpe";
  }
  return "";
}

std::optional<Metric> metric_named(std::string_view name) {
  for (const Metric metric : EvaluationSettings{}.metrics) {
    if (name_of(metric) == name) return metric;
  }
  return std::nullopt;
}

EvaluationSettings EvaluationSettings::room_scale() {
  EvaluationSettings settings;
  settings.radius_m = 0.2;
  settings.adjustment = AdjustmentSettings::room_scale();
  return settings;
}

bool EvaluationSettings::wants(Metric metric) const {
  return std::find(metrics.begin(), metrics.end(), metric) != metrics.end();
}

void EvaluationSettings::validate() const {
  if (metrics.empty()) throw InvalidArgument("metrics is empty: at least one metric must be asked for");
  NeighborhoodSettings{.radius_m = radius_m, .min_neighbors = min_neighbors}.validate();
  NeighborhoodSettings{.radius_m = radius_m, .min_neighbors = min_neighbors_orthogonal}.validate();
  if (query_every < 1) throw InvalidArgument("query_every = 0 is out of range: it must be at least 1");
  MapSettings{.min_range_m = min_range_m, .max_range_m = max_range_m}.validate();
  if (window && *window < 2) {
    throw InvalidArgument(fmt::format("window = {} is out of range: it must be at least 2 scans", *window));
  }
  if (stride && *stride < 1) throw InvalidArgument("stride = 0 is out of range: it must be at least 1 scan");
  if (stride && !window) throw InvalidArgument("stride is given without a window");
  orthogonal.validate();
}

}  // namespace trysquare
