// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/pose.h"
#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/pipeline/evaluation.h"
#include "trysquare/pipeline/evaluation_settings.h"
#include "trysquare/stats/interval.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trysquare {

/// One of the trajectories that are compared.
struct Candidate {
  std::string name;
  Trajectory world_from_scan;            ///< N poses, each candidate in a world of its own.
  std::optional<Pose> body_from_sensor;  ///< The extrinsic that is part of the trajectory; empty: none.
};

/// How trajectories are compared.
struct ComparisonSettings {
  EvaluationSettings
      evaluation;  ///< `window` empty: of 2 to 10 scans, so that there are ten windows if possible. May not overlap.
  double confidence = 0.95;  ///< Of intervals; differences are called real at p <= 1 − confidence. In (0, 1).

  void validate() const;  ///< @throws InvalidArgument
};

/// Two candidates, window by window, by one metric. Lower is better.
struct PairedDifference {
  std::size_t first = 0;  ///< Index of a candidate.
  std::size_t second = 0;
  std::size_t num_windows = 0;            ///< In which both have a value that means something.
  std::size_t num_first_better = 0;       ///< Of those.
  std::optional<double> mean_difference;  ///< first − second, in the unit of the metric; empty: no common window.
  std::optional<Interval> interval;       ///< Of the mean difference; empty: fewer than six windows.
  std::optional<double> p_value;          ///< Of "they are alike": exact sign-flip test; empty: no common window.
  std::optional<double> p_adjusted;       ///< Corrected for all pairs of this metric (Holm).
  bool windows_can_tell = false;          ///< They are enough for a difference to be found real among so many pairs.
  std::optional<std::size_t> better;      ///< `first` or `second`; empty: they cannot be told apart.
};

/// All pairs of candidates by one metric, and the order that follows.
struct MetricComparison {
  Metric metric = Metric::kRpe;
  std::vector<PairedDifference> pairs;
  std::vector<std::size_t> ranks;  ///< By candidate: 1 + the number of candidates that are better. Ties share a rank.
};

/// A candidate by itself.
struct ComparedTrajectory {
  std::string name;
  Evaluation evaluation;          ///< Without map and point values. Windows' RPE: against the common adjusted poses.
  std::optional<double> rpe_m;    ///< All pairs against the common adjusted poses, their noise removed.
  std::optional<double> rpe_rad;  ///< Its rotation.
  std::optional<Interval> interval_m;  ///< Of rpe_m, as that of an estimate.
};

/// Everything compare() finds out.
struct Comparison {
  ComparisonSettings settings;
  std::vector<ComparedTrajectory> trajectories;
  std::optional<std::size_t> adjusted_from;    ///< Whose estimate gives the adjusted poses; empty: all are refused.
  std::optional<double> adjusted_agreement_m;  ///< Largest RPE between adjusted poses of two candidates; empty: one.
  std::vector<MetricComparison> by_metric;     ///< In the order of the settings.
  std::optional<Metric> decisive;              ///< RPE if there are adjusted poses, else the first with any pair.
  std::vector<std::size_t> best;               ///< Candidates of rank 1 by the decisive metric: more than one is a tie.
  Verdict verdict;
};

/// Which of several trajectories of the same scans is better, and whether the difference is real.
///
/// Every candidate is evaluated by itself. The best accepted RPE estimate gives adjusted poses in which the scans
/// agree; the RPE of every candidate is measured against those, so also that of one whose own estimate is refused
/// because it is too far off. Values of the same windows of scans are then paired.
///
/// @param scans       N scans.
/// @param candidates  Two or more, of N poses each.
/// @throws InvalidArgument  if a setting is out of range, there are fewer than two candidates, two have the same name,
/// or
///                          one has not N poses.
/// @throws IoError          from ScanSequence::load().
///
/// Source: docs/definitions.md#comparison.
Comparison compare(const ScanSequence& scans, std::span<const Candidate> candidates,
                   const ComparisonSettings& settings = {}, const Execution& execution = {});

}  // namespace trysquare
