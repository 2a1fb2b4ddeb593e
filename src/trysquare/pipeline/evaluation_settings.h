// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/adjustment_settings.h"
#include "trysquare/metrics/definition.h"
#include "trysquare/metrics/extract_orthogonal_subset.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace trysquare {

/// The metrics of an evaluation. kRpe is the estimate of the RPE without ground truth.
enum class Metric { kMme, kMpv, kOmme, kMom, kRpe };

/// "mme", "mpv", "omme", "mom", "rpe".
std::string_view name_of(Metric metric);

/// The metric that name_of() calls `name`; nullopt when there is none.
std::optional<Metric> metric_named(std::string_view name);

/// How scans and poses are judged. Defaults are those of the paper's LiDAR experiments.
struct EvaluationSettings {
  std::vector<Metric> metrics = {Metric::kMme, Metric::kMpv, Metric::kOmme, Metric::kMom, Metric::kRpe};
  Definition definition = Definition::kPaper;
  double radius_m = 1.0;             ///< Of the neighborhood W(p), > 0 [m].
  int min_neighbors = 6;             ///< For MME and MPV, the query included; >= 3.
  int min_neighbors_orthogonal = 4;  ///< For MOM and OMME; >= 3.
  std::size_t query_every = 1;       ///< Of the kept map points, in scan order, those with index % query_every == 0.
  double min_range_m = 0;            ///< Points nearer to the sensor are dropped [m].
  double max_range_m = std::numeric_limits<double>::infinity();  ///< Points farther away are dropped [m].
  std::optional<std::size_t>
      window;  ///< Scans per window, >= 2; empty: 10 when there are at least 20 scans, else none.
  std::optional<std::size_t> stride;  ///< Scans from one window to the next, >= 1; empty: the window.
  OrthogonalSubsetSettings orthogonal;
  AdjustmentSettings adjustment;  ///< Of the RPE estimate; its range limits are those above.

  /// The same for rooms seen by a depth camera: a radius of 0.2 m, and patches of a fifth for the RPE estimate.
  static EvaluationSettings room_scale();

  bool wants(Metric metric) const;
  void validate() const;  ///< @throws InvalidArgument
};

}  // namespace trysquare
