// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/experiments/metric_correlations.h"
#include "trysquare/experiments/metric_study.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trysquare {

/// The experiments of the paper's §V, by the scenes whose poses are perturbed.
enum class ExperimentKind {
  kCounterexample,  ///< Three planes: balanced, unbalanced, non-orthogonal.
  kPlanes,          ///< Random plane worlds.
  kStreet,          ///< Simulated streets, with CARLA's sensor of 32 beams.
  kTown,            ///< Simulated towns of three styles, with the same.
  kScans,           ///< Scans that are at hand, with their poses: KITTI.
};

/// "counterexample", "planes", "street", "town", "kitti".
constexpr std::string_view name_of(ExperimentKind kind) {
  switch (kind) {
    case ExperimentKind::kCounterexample:
      return "counterexample";
    case ExperimentKind::kPlanes:
      return "planes";
    case ExperimentKind::kStreet:
      return "street";
    case ExperimentKind::kTown:
      return "town";
    case ExperimentKind::kScans:
      break;
  }
  return "kitti";
}

/// What an experiment does. Defaults are the paper's protocol.
struct ExperimentSettings {
  ExperimentKind kind = ExperimentKind::kPlanes;
  std::size_t num_environments = 50;                 ///< Of every group of scenes, >= 1.
  std::vector<std::size_t> num_poses = {5, 15, 30};  ///< Lengths of the trajectories, each >= 2, ascending.
  std::vector<double> rotation_sigmas_rad = {0};     ///< Each makes a study of its own.
  std::size_t num_trajectories = 200;
  double translation_sigma_m = 0.05;  ///< Per axis.
  NoiseModel noise_model = NoiseModel::kWhite;
  double point_sigma_m = 0.01;  ///< Of the points of discs.
  double radius_m = 1.0;        ///< Of the neighborhoods.
  StudySceneSettings scene{};
  IntervalMethod intervals = IntervalMethod::kBootstrap;
  BootstrapSettings bootstrap{};  ///< Its seed is not used: that of the experiment is.
  std::uint64_t seed = 0;

  void validate() const;  ///< @throws InvalidArgument
};

/// The settings that an experiment of this kind has by default.
ExperimentSettings default_experiment(ExperimentKind kind);

/// One study of an experiment: a scene, a number of poses, a size of noise. Studies do not depend on each other.
struct ExperimentUnit {
  std::string group;            ///< What is summed up together: "balanced", "planes", "town-grid".
  std::size_t environment = 0;  ///< Number of the scene within its group.
  std::size_t num_poses = 0;
  double rotation_sigma_rad = 0;

  /// A file name without ending: "balanced-e00-n05".
  std::string name() const;
};

/// All studies of an experiment, group by group, length by length.
/// @throws InvalidArgument  if `settings` is out of range.
std::vector<ExperimentUnit> experiment_units(const ExperimentSettings& settings);

/// The data set of an experiment of kind kScans. Not owned.
struct ExperimentData {
  const ScanSequence* scans = nullptr;
  const Trajectory* true_poses = nullptr;  ///< Of the sensor.
};

/// Does one study.
/// @param data       For kScans: environment e takes the scans from e · (longest number of poses) on.
/// @param execution  Threads. The result is bit-identical for every value.
/// @throws InvalidArgument  if `settings` is out of range, or there are not enough scans.
MetricSamples run_unit(const ExperimentSettings& settings, const ExperimentUnit& unit, const ExperimentData& data = {},
                       const Execution& execution = {});

/// What one study says. The bootstrap's seed is made of the experiment's seed and the study's.
std::vector<MetricCorrelation> correlations_of(const ExperimentSettings& settings, const ExperimentUnit& unit,
                                               const MetricSamples& samples);

/// One row of the summary: what the environments of a group say at one number of poses.
struct GroupSummary {
  std::string group;
  std::size_t num_poses = 0;
  double rotation_sigma_rad = 0;
  std::vector<MetricSummary> metrics;
};

/// @param correlations  Of every unit, in the order of `units`.
std::vector<GroupSummary> summarize(const ExperimentSettings& settings, const std::vector<ExperimentUnit>& units,
                                    const std::vector<std::vector<MetricCorrelation>>& correlations);

}  // namespace trysquare
