// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/error.h"
#include "trysquare/core/execution.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/experiments/study_scene.h"
#include "trysquare/synthetic/perturb.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trysquare {

/// What is done to the true poses of a scene, how often, and how the maps are looked at.
struct MetricStudySettings {
  std::size_t num_trajectories = 200;  ///< >= 1
  PerturbationSettings noise{};        ///< Trajectory k is drawn with a seed made of noise.seed and k.
  double radius_m = 1.0;               ///< Of the neighborhoods [m].
  int min_neighbors = 6;               ///< Of MME and MPV, >= 3.
  int min_neighbors_orthogonal = 4;    ///< Of MOM and OMME, >= 3.

  void validate() const;  ///< @throws InvalidArgument
};

/// A table: one row a trajectory, NaN where a metric is undefined.
struct MetricSamples {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  /// The values of one column.
  /// @throws InvalidArgument  if there is no such column.
  std::vector<double> column(std::string_view name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) throw InvalidArgument("no column '" + std::string(name) + "'");
    const auto index = static_cast<std::size_t>(found - columns.begin());
    std::vector<double> values;
    values.reserve(rows.size());
    for (const std::vector<double>& row : rows) values.push_back(row.at(index));
    return values;
  }
};

/// The columns of metric_samples(): "paper_rpe" [m²], "rpe" (rms over all pairs [m]), "mme" [nats], "mpv" [m²], and for
/// every subset "omme" [nats], "mom" [m²] and "mom_sum_of_medians" [m²], with its suffix.
std::vector<std::string> sample_columns(std::span<const StudySubset> subsets);

/// Those of the columns that are metrics of the map: what is correlated with "paper_rpe".
std::vector<std::string> metric_columns(std::span<const std::string> columns);

/// The metrics of one trajectory: one row of the table.
/// @param estimate  A pose for every scan of the scene.
/// @throws InvalidArgument  if scene, trajectory or settings are out of range.
std::vector<double> metric_sample(const StudyScene& scene, const Trajectory& estimate,
                                  const MetricStudySettings& settings);

/// Perturbs the true poses num_trajectories times and computes the metrics of every map.
///
/// @param execution  Threads. The result is bit-identical for every value.
/// @throws InvalidArgument  as metric_sample().
///
/// Source: Kornilova & Ferrer, "Be your own Benchmark", §V-A.
/// Differs: query points are a part of the map, and stay the same points for all trajectories.
/// Cost:    that of the neighborhoods, mostly: 1 ms a scan of 20,000 points and trajectory for 800 queries on a street,
///          0.1 ms in a plane world.
MetricSamples metric_samples(const StudyScene& scene, const MetricStudySettings& settings,
                             const Execution& execution = {});

}  // namespace trysquare
