// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/rpe_estimate.h"
#include "trysquare/core/diagnostic.h"
#include "trysquare/core/pose.h"
#include "trysquare/core/registered_map.h"
#include "trysquare/metrics/metric_result.h"
#include "trysquare/metrics/orthogonal_metric_result.h"
#include "trysquare/metrics/orthogonal_statistics.h"
#include "trysquare/metrics/overlap.h"
#include "trysquare/pipeline/evaluation_settings.h"
#include "trysquare/stats/error_statistics.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// What an evaluation was made of.
struct EvaluationInputs {
  std::size_t num_scans = 0;
  std::size_t num_points = 0;               ///< Points of the map, after everything was dropped that had to be.
  std::size_t num_not_finite_points = 0;    ///< Dropped: a coordinate was NaN or infinite.
  std::size_t num_origin_points = 0;        ///< Exactly at the sensor: dropped from scans, kept (and counted) in `map`.
  std::size_t num_out_of_range_points = 0;  ///< Dropped by min_range_m and max_range_m.
  std::size_t num_duplicate_points = 0;     ///< Points that equal another one of the map exactly; they are kept.
};

/// Full-reference errors of the same poses; present when a reference trajectory was given.
struct ReferenceErrors {
  ErrorStatistics rpe;                 ///< Translation over all pairs i < j [m].
  ErrorStatistics rpe_rotation;        ///< Rotation angle over all pairs i < j [rad].
  std::optional<ErrorStatistics> ape;  ///< Translation after SE(3) alignment [m]; empty where alignment is ambiguous.
  std::string ape_reason;              ///< Why `ape` is empty.
  double paper_rpe = 0;                ///< 1/N Σ over ordered pairs of the squared translation [m²]. Paper §III-A.
};

/// The metrics of the map of consecutive scans [first, last].
struct WindowEvaluation {
  std::size_t first = 0;
  std::size_t last = 0;  ///< Inclusive.
  MetricResult mpv;
  MetricResult mme;
  OrthogonalMetricResult mom;
  OrthogonalMetricResult omme;
  Overlap overlap;
  bool meaningful = false;  ///< The scans overlap enough (kLeastMultiScanShare); else the values can mislead.
  std::optional<double> rpe_translation_rms_m;  ///< Against the reference, all pairs of the window.
  std::optional<double> rpe_estimate_m;  ///< Against the adjusted poses, likewise, its noise not removed.
};

/// How a metric of the windows goes along with the true RPE of the windows; present with a reference.
struct WindowCorrelation {
  std::string metric;             ///< "mom", "omme", "mpv" or "mme".
  std::size_t num_windows = 0;    ///< Windows in which the metric is defined.
  std::optional<double> pearson;  ///< Empty for fewer than three windows or without variation.
  std::optional<double> spearman;
  std::optional<double> kendall_tau_b;
};

/// Whether the numbers mean anything, and why not.
struct Verdict {
  bool meaningful = false;
  std::vector<std::string> reasons;
};

/// Everything evaluate() finds out. Reports and files are views of this.
struct Evaluation {
  EvaluationInputs inputs;
  EvaluationSettings settings;
  std::optional<MetricResult> mpv;  ///< Empty: not asked for. So for the others.
  std::optional<MetricResult> mme;
  std::optional<OrthogonalMetricResult> mom;
  std::optional<OrthogonalMetricResult> omme;
  Overlap overlap;
  std::optional<RpeEstimate> rpe_estimate;  ///< Empty: not asked for, or no poses.
  std::optional<ReferenceErrors> reference;
  std::vector<WindowEvaluation> windows;
  std::size_t num_scans_outside_windows = 0;  ///< Scans at the end that fill no window.
  std::vector<WindowCorrelation> window_correlations;
  std::vector<Diagnostic> warnings;
  Verdict verdict;

  Pose world_from_map;
  std::vector<Eigen::Vector3d> positions_in_map;  ///< Sensor position of every scan [m]; empty for `map`.

  /// The map and its points' values, for writing them out; not part of the report.
  RegisteredMap map;
  std::vector<std::size_t> query_indices;  ///< Map points that were queries: point_statistics is in this order.
  PointStatistics query_statistics;
  OrthogonalSubset subset;
};

}  // namespace trysquare
