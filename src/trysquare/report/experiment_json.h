// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/experiments/experiment.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trysquare {

/// What only the caller of an experiment knows.
struct ExperimentFacts {
  std::string version;                 ///< Of trysquare.
  std::optional<std::string> scans{};  ///< Of an experiment on scans, as typed.
  std::optional<std::string> poses{};
};

/// The settings of an experiment as JSON text: two runs with the same text have the same results.
std::string settings_json(const ExperimentSettings& settings, const ExperimentFacts& facts);

/// An experiment as JSON text, schema "trysquare.experiment/1" (docs/schema/experiment.schema.json): for each group of
/// scenes, size of noise and number of poses, how well each metric follows the paper's RPE: mean, standard deviation
/// and interval over the environments. Same input, same bytes.
std::string to_json(const ExperimentSettings& settings, std::span<const GroupSummary> groups,
                    const ExperimentFacts& facts);

/// The correlations of every study, a line a metric: group, environment, rotation_sigma_deg, num_poses, metric,
/// num_defined, and for each coefficient its value and the ends of its interval. Empty cells where undefined.
/// @param correlations  Of every unit, in the order of `units`.
std::string correlations_csv(std::span<const ExperimentUnit> units,
                             std::span<const std::vector<MetricCorrelation>> correlations);

/// The summary, a line a metric of a group.
std::string summary_csv(std::span<const GroupSummary> groups);

}  // namespace trysquare
