// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/rpe_estimate.h"
#include "trysquare/core/execution.h"
#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/synthetic/perturb.h"

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trysquare {

/// What is done to the true poses before their RPE is estimated.
struct EstimateStudySettings {
  PerturbationSettings noise{.translation_sigma_m = 0.05, .rotation_sigma_rad = 0.2 * std::numbers::pi / 180};
  double least_factor = 0.1;  ///< Every trajectory draws how much of the noise it gets, from here, >= 0, ...
  double most_factor = 2;     ///< ... to here, uniformly; >= least_factor.
  double outlier_m = 0;       ///< One pose other than the first is moved by this in any direction; 0: none.
  AdjustmentSettings adjustment{};

  void validate() const;  ///< @throws InvalidArgument
};

/// A trajectory with errors that are known.
struct DisturbedTrajectory {
  Trajectory given;
  std::optional<std::size_t> outlier{};  ///< The pose that was moved.
};

/// Trajectory `number` of a study: the same whatever the others are.
///
/// A random walk takes steps of sqrt(3 / N) of the noise, so that long trajectories are not off by more than short
/// ones.
/// @throws InvalidArgument  if `settings` is out of range, or an outlier is asked for and there is one pose only.
DisturbedTrajectory disturb(const Trajectory& true_poses, const EstimateStudySettings& settings, std::size_t number);

/// An estimate beside the truth. RPE are over all pairs, but those of by_pairs.
struct EstimateSample {
  double true_m = 0;
  double true_rad = 0;
  EstimateStatus status = EstimateStatus::kRefused;
  std::vector<std::string> reasons{};  ///< Why it is not measured.
  std::optional<double> estimate_m{};  ///< Empty when refused.
  std::optional<double> estimate_rad{};
  std::optional<std::array<double, 2>> interval_m{};  ///< Only when measured.
  std::optional<std::array<double, 2>> interval_rad{};
  std::optional<double> upper_bound_m{};        ///< Only for a bound.
  bool has_outlier = false;                     ///< A pose was moved.
  std::optional<bool> outlier_has_top_score{};  ///< Empty when refused, or without an outlier.
  std::optional<bool> outlier_is_farthest{};    ///< Its translation is the farthest off. Likewise.
  bool outlier_is_suspect = false;
  std::size_t num_good_poses = 0;          ///< Poses that were not moved; 0 when refused.
  std::size_t num_false_suspects = 0;      ///< Of these, those called suspects.
  std::vector<EstimateSample> by_pairs{};  ///< The same of consecutive poses, of 10 frames, of 10 m, if there are.
};

/// Estimates the RPE of one trajectory and looks up the truth.
/// @throws  as estimate_rpe().
EstimateSample estimate_sample(const ScanSequence& scans, const Trajectory& true_poses,
                               const DisturbedTrajectory& disturbed, const AdjustmentSettings& settings,
                               const Execution& execution = {});

/// A number was given as measured and is off by more than a tenth of the truth and more than a centimetre, or a bound
/// was given that does not hold by as much.
bool is_wrong_acceptance(const EstimateSample& sample);

/// How good the estimates of some trajectories of one scene are. Empty: no sample says anything about it.
struct EstimateQuality {
  std::size_t num_samples = 0;
  std::size_t num_measured = 0;
  std::size_t num_bounds = 0;
  std::size_t num_refused = 0;
  std::size_t num_wrong = 0;                 ///< is_wrong_acceptance()
  std::optional<double> pearson{};           ///< Of estimate² and truth², translation, where there is an estimate.
  std::optional<double> kendall{};           ///< Likewise.
  std::optional<double> rotation_pearson{};  ///< Likewise, rotation.
  std::optional<double> slope{};             ///< Of the line through the origin: estimate = slope · truth.
  std::optional<double> median_error{};      ///< Of |estimate − truth| / truth.
  std::optional<double> coverage{};          ///< Share of the intervals that hold the truth, translation.
  std::optional<double> rotation_coverage{};
  std::optional<double> median_width{};    ///< Of an interval, from its middle to an end, over the estimate.
  std::optional<double> outliers_found{};  ///< Share of the outliers that have the top score; a refusal finds nothing.
  std::optional<double> outliers_farthest{};   ///< Share of those whose translation is the farthest off. Likewise.
  std::optional<double> outliers_suspected{};  ///< Share of those called suspects. Likewise.
  std::optional<double> false_suspects{};      ///< Share of the good poses that are called suspects.
};

/// How good the estimates of a study are, all of its samples together.
EstimateQuality quality_of(std::span<const EstimateSample> samples);

}  // namespace trysquare
