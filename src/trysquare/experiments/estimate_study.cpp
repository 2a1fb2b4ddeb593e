// SPDX-License-Identifier: Apache-2.0
#include "trysquare/experiments/estimate_study.h"

#include "trysquare/core/error.h"
#include "trysquare/stats/correlation.h"
#include "trysquare/stats/median.h"
#include "trysquare/synthetic/random.h"
#include "trysquare/trajectory/all_pairs_rpe.h"
#include "trysquare/trajectory/rpe.h"

#include <algorithm>
#include <cmath>

namespace trysquare {
namespace {

constexpr double kWrongShare = 0.1;
constexpr double kWrong_m = 0.01;

bool is_off(double excess_m, double true_m) { return excess_m > std::max(kWrongShare * true_m, kWrong_m); }

std::vector<double> squares_of(std::vector<double> values) {
  for (double& value : values) value *= value;
  return values;
}

bool holds(const std::array<double, 2>& interval, double value) { return interval[0] <= value && value <= interval[1]; }

std::optional<double> share(std::size_t part, std::size_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

/// Estimates and what they should be.
struct Estimates {
  std::vector<double> truth;
  std::vector<double> estimate;

  void add(double true_value, const std::optional<double>& estimated) {
    if (!estimated) return;
    truth.push_back(true_value);
    estimate.push_back(*estimated);
  }
};

std::optional<double> slope_of(const Estimates& estimates) {
  double products = 0;
  double squares = 0;
  for (std::size_t i = 0; i < estimates.truth.size(); ++i) {
    products += estimates.truth[i] * estimates.estimate[i];
    squares += estimates.truth[i] * estimates.truth[i];
  }
  if (!(squares > 0)) return std::nullopt;
  return products / squares;
}

std::optional<double> median_error_of(const Estimates& estimates) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < estimates.truth.size(); ++i) {
    if (estimates.truth[i] > 0) errors.push_back(std::abs(estimates.estimate[i] / estimates.truth[i] - 1));
  }
  return median_of_defined(errors);
}

void add_intervals(std::span<const EstimateSample> samples, EstimateQuality& quality) {
  std::size_t num_intervals = 0;
  std::size_t num_intervals_rad = 0;
  std::size_t num_holding = 0;
  std::size_t num_holding_rad = 0;
  std::vector<double> widths;
  for (const EstimateSample& sample : samples) {
    if (!sample.interval_m) continue;
    ++num_intervals;
    num_holding += holds(*sample.interval_m, sample.true_m) ? 1U : 0U;
    if (sample.interval_rad) ++num_intervals_rad;
    num_holding_rad += sample.interval_rad && holds(*sample.interval_rad, sample.true_rad) ? 1U : 0U;
    widths.push_back(((*sample.interval_m)[1] - (*sample.interval_m)[0]) / 2 / *sample.estimate_m);
  }
  quality.coverage = share(num_holding, num_intervals);
  quality.rotation_coverage = share(num_holding_rad, num_intervals_rad);
  quality.median_width = median_of_defined(widths);
}

void add_outliers(std::span<const EstimateSample> samples, EstimateQuality& quality) {
  std::size_t num_outliers = 0;
  std::size_t num_found = 0;
  std::size_t num_farthest = 0;
  std::size_t num_suspected = 0;
  std::size_t num_good = 0;
  std::size_t num_false = 0;
  for (const EstimateSample& sample : samples) {
    num_outliers += sample.has_outlier ? 1U : 0U;
    num_found += sample.outlier_has_top_score.value_or(false) ? 1U : 0U;
    num_farthest += sample.outlier_is_farthest.value_or(false) ? 1U : 0U;
    num_suspected += sample.outlier_is_suspect ? 1U : 0U;
    num_good += sample.num_good_poses;
    num_false += sample.num_false_suspects;
  }
  quality.outliers_found = share(num_found, num_outliers);
  quality.outliers_farthest = share(num_farthest, num_outliers);
  quality.outliers_suspected = share(num_suspected, num_outliers);
  quality.false_suspects = share(num_false, num_good);
}

}  // namespace

void EstimateStudySettings::validate() const {
  noise.validate();
  adjustment.validate();
  if (!(least_factor >= 0 && least_factor <= most_factor && std::isfinite(most_factor))) {
    throw InvalidArgument("the factors of the noise must be finite, not negative, and the least not above the most");
  }
  if (!(outlier_m >= 0 && std::isfinite(outlier_m))) throw InvalidArgument("outlier_m must be finite and >= 0");
}

DisturbedTrajectory disturb(const Trajectory& true_poses, const EstimateStudySettings& settings, std::size_t number) {
  settings.validate();
  if (settings.outlier_m > 0 && true_poses.size() < 2) {
    throw InvalidArgument("an outlier among the poses takes two poses or more");
  }
  Random random(settings.noise.seed, number);
  double factor = settings.least_factor + (settings.most_factor - settings.least_factor) * random.uniform();
  if (settings.noise.model == NoiseModel::kWalk) factor *= std::sqrt(3.0 / static_cast<double>(true_poses.size()));
  PerturbationSettings noise = settings.noise;
  noise.translation_sigma_m *= factor;
  noise.rotation_sigma_rad *= factor;
  noise.seed = random.bits();
  DisturbedTrajectory result{.given = perturb(true_poses, noise)};
  if (settings.outlier_m > 0) {
    const auto num_others = static_cast<double>(true_poses.size() - 1);
    result.outlier = 1 + static_cast<std::size_t>(random.uniform() * num_others);
    result.given.world_from_scan[*result.outlier].translation += settings.outlier_m * random.unit_direction();
  }
  return result;
}

namespace {

std::vector<EstimateSample> samples_by_pairs(const RpeEstimate& estimate, const Trajectory& true_poses,
                                             const Trajectory& given) {
  std::vector<EstimateSample> samples;
  for (const PairRpe& pairs : estimate.by_pairs) {
    if (pairs.num_pairs == 0) continue;
    RpeSettings relation{.pairs = pairs.pairs};
    samples.push_back({.true_m = rpe(true_poses, given, relation).statistics.rmse,
                       .status = pairs.status,
                       .estimate_m = pairs.translation_rms_m,
                       .estimate_rad = pairs.rotation_rms_rad,
                       .interval_m = pairs.interval_m,
                       .upper_bound_m = pairs.upper_bound_m});
    relation.relation = PoseRelation::kRotationAngleRad;
    samples.back().true_rad = rpe(true_poses, given, relation).statistics.rmse;
  }
  return samples;
}

}  // namespace

EstimateSample estimate_sample(const ScanSequence& scans, const Trajectory& true_poses,
                               const DisturbedTrajectory& disturbed, const AdjustmentSettings& settings,
                               const Execution& execution) {
  const RpeEstimate estimate = estimate_rpe(scans, disturbed.given, settings, execution);
  const AllPairsRpe truth = all_pairs_rpe(true_poses, disturbed.given);
  EstimateSample sample{.true_m = truth.translation_m.rmse,
                        .true_rad = truth.rotation_rad.rmse,
                        .status = estimate.status,
                        .reasons = estimate.reasons,
                        .estimate_m = estimate.translation_rms_m,
                        .estimate_rad = estimate.rotation_rms_rad,
                        .interval_m = estimate.interval_m,
                        .interval_rad = estimate.interval_rad,
                        .upper_bound_m = estimate.upper_bound_m,
                        .has_outlier = disturbed.outlier.has_value(),
                        .by_pairs = samples_by_pairs(estimate, true_poses, disturbed.given)};
  const auto distance_m = [&](std::size_t i) { return estimate.poses[i].deviation.error.translation_m.norm(); };
  std::size_t top = 0;
  std::size_t farthest = 0;
  for (std::size_t i = 0; i < estimate.poses.size(); ++i) {
    const PoseDeviation& deviation = estimate.poses[i].deviation;
    if (deviation.score > estimate.poses[top].deviation.score) top = i;
    if (distance_m(i) > distance_m(farthest)) farthest = i;
    if (i == disturbed.outlier) {
      sample.outlier_is_suspect = deviation.suspect;
      continue;
    }
    ++sample.num_good_poses;
    sample.num_false_suspects += deviation.suspect ? 1U : 0U;
  }
  if (disturbed.outlier && !estimate.poses.empty()) {
    sample.outlier_has_top_score = top == *disturbed.outlier;
    sample.outlier_is_farthest = farthest == *disturbed.outlier;
  }
  return sample;
}

bool is_wrong_acceptance(const EstimateSample& sample) {
  switch (sample.status) {
    case EstimateStatus::kMeasured:
      return is_off(std::abs(*sample.estimate_m - sample.true_m), sample.true_m);
    case EstimateStatus::kBound:
      return is_off(sample.true_m - *sample.upper_bound_m, sample.true_m);
    case EstimateStatus::kRefused:
      break;
  }
  return false;
}

EstimateQuality quality_of(std::span<const EstimateSample> samples) {
  EstimateQuality quality{.num_samples = samples.size()};
  Estimates translations;
  Estimates rotations;
  for (const EstimateSample& sample : samples) {
    quality.num_measured += sample.status == EstimateStatus::kMeasured ? 1U : 0U;
    quality.num_bounds += sample.status == EstimateStatus::kBound ? 1U : 0U;
    quality.num_refused += sample.status == EstimateStatus::kRefused ? 1U : 0U;
    quality.num_wrong += is_wrong_acceptance(sample) ? 1U : 0U;
    translations.add(sample.true_m, sample.estimate_m);
    rotations.add(sample.true_rad, sample.estimate_rad);
  }
  const std::vector<double> truth_m2 = squares_of(translations.truth);
  const std::vector<double> estimate_m2 = squares_of(translations.estimate);
  quality.pearson = pearson(estimate_m2, truth_m2);
  quality.kendall = kendall_tau_b(estimate_m2, truth_m2);
  quality.rotation_pearson = pearson(squares_of(rotations.estimate), squares_of(rotations.truth));
  quality.slope = slope_of(translations);
  quality.median_error = median_error_of(translations);
  add_intervals(samples, quality);
  add_outliers(samples, quality);
  return quality;
}

}  // namespace trysquare
