// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/pipeline/evaluation_settings.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace trysquare::app {

/// The options that say which metrics are computed, and how. They are declared straight into the settings, so that
/// defaults have one home; what needs more than a number is resolved afterwards.
struct MetricOptions {
  EvaluationSettings settings;
  std::optional<double> radius_m;
  std::optional<int> min_neighbors;
  std::string preset = "lidar";
  std::string definition = "paper";
  std::string metrics = "all";
  std::string subset;
  std::string subset_method = "patches";
  bool no_colinear = false;

  /// @throws InvalidArgument  if something is out of range.
  EvaluationSettings resolve() const;
};

void add_metric_options(CLI::App& verb, MetricOptions& options);

/// The options of the extraction alone, for verbs that compute no metric.
void add_orthogonal_options(CLI::App& verb, MetricOptions& options);

}  // namespace trysquare::app
