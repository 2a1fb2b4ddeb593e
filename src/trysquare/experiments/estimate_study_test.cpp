// SPDX-License-Identifier: Apache-2.0
#include "trysquare/experiments/estimate_study.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trysquare {
namespace {

Trajectory straight_trajectory(std::size_t num_poses) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < num_poses; ++i) {
    trajectory.world_from_scan.push_back({.translation = {static_cast<double>(i), 0, 0}});
  }
  return trajectory;
}

EstimateSample measured(double true_m, double estimate_m) {
  return {.true_m = true_m,
          .true_rad = true_m,
          .status = EstimateStatus::kMeasured,
          .estimate_m = estimate_m,
          .estimate_rad = estimate_m,
          .interval_m = {{0.95 * estimate_m, 1.05 * estimate_m}},
          .interval_rad = {{0.95 * estimate_m, 1.05 * estimate_m}}};
}

EstimateSample bounded(double true_m, double upper_bound_m) {
  return {.true_m = true_m,
          .status = EstimateStatus::kBound,
          .estimate_m = upper_bound_m,
          .estimate_rad = 0,
          .upper_bound_m = upper_bound_m};
}

TEST(EstimateStudy, MovesOnePoseByTheOutlierAndNoOther) {
  const Trajectory truth = straight_trajectory(10);
  const EstimateStudySettings settings{.noise = {}, .outlier_m = 0.5};
  const DisturbedTrajectory disturbed = disturb(truth, settings, 3);
  ASSERT_TRUE(disturbed.outlier);
  EXPECT_GT(*disturbed.outlier, 0U);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double moved_m =
        (disturbed.given.world_from_scan[i].translation - truth.world_from_scan[i].translation).norm();
    EXPECT_NEAR(moved_m, i == *disturbed.outlier ? 0.5 : 0, 1e-12) << "pose " << i;
  }
}

TEST(EstimateStudy, DrawsTheNoiseOfATrajectoryWithinItsFactors) {
  const Trajectory truth = straight_trajectory(2000);
  EstimateStudySettings settings{.noise = {.translation_sigma_m = 0.1}, .least_factor = 0.5, .most_factor = 0.6};
  for (std::size_t number = 0; number < 5; ++number) {
    const DisturbedTrajectory disturbed = disturb(truth, settings, number);
    double sum_m2 = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      sum_m2 += (disturbed.given.world_from_scan[i].translation - truth.world_from_scan[i].translation).squaredNorm();
    }
    const double sigma_m = std::sqrt(sum_m2 / 3 / static_cast<double>(truth.size()));
    EXPECT_GT(sigma_m, 0.048) << "trajectory " << number;
    EXPECT_LT(sigma_m, 0.062) << "trajectory " << number;
  }
}

TEST(EstimateStudy, CallsAMeasurementWrongThatIsOffByATenthAndACentimetre) {
  EXPECT_FALSE(is_wrong_acceptance(measured(0.05, 0.0595)));
  EXPECT_TRUE(is_wrong_acceptance(measured(0.05, 0.0605)));
  EXPECT_FALSE(is_wrong_acceptance(measured(1, 0.91)));
  EXPECT_TRUE(is_wrong_acceptance(measured(1, 0.89)));
}

TEST(EstimateStudy, CallsABoundWrongOnlyWhenTheTruthIsAboveIt) {
  EXPECT_FALSE(is_wrong_acceptance(bounded(0.001, 0.03)));
  EXPECT_FALSE(is_wrong_acceptance(bounded(0.039, 0.03)));
  EXPECT_TRUE(is_wrong_acceptance(bounded(0.041, 0.03)));
}

TEST(EstimateStudy, LeavesRefusalsOutOfTheErrorsAndCountsThem) {
  const std::vector<EstimateSample> samples = {measured(0.1, 0.11), measured(0.2, 0.22), EstimateSample{.true_m = 5},
                                               measured(0.3, 0.306)};
  const EstimateQuality quality = quality_of(samples);
  EXPECT_EQ(quality.num_refused, 1U);
  EXPECT_EQ(quality.num_measured, 3U);
  EXPECT_NEAR(*quality.median_error, 0.1, 1e-12);
  EXPECT_NEAR(*quality.slope, (0.1 * 0.11 + 0.2 * 0.22 + 0.3 * 0.306) / (0.01 + 0.04 + 0.09), 1e-12);
  EXPECT_NEAR(*quality.coverage, 1.0 / 3, 1e-12);
  EXPECT_NEAR(*quality.median_width, 0.05, 1e-12);
  EXPECT_DOUBLE_EQ(*quality.kendall, 1);
  EXPECT_FALSE(quality.outliers_found) << "there were none to find";
}

TEST(EstimateStudy, CountsARefusalAsAnOutlierThatWasNotFound) {
  EstimateSample found = measured(0.1, 0.1);
  found.has_outlier = true;
  found.outlier_has_top_score = true;
  found.outlier_is_farthest = true;
  found.outlier_is_suspect = true;
  EstimateSample farthest_only = measured(0.1, 0.1);
  farthest_only.has_outlier = true;
  farthest_only.outlier_has_top_score = false;
  farthest_only.outlier_is_farthest = true;
  const std::vector<EstimateSample> samples = {found, farthest_only, EstimateSample{.has_outlier = true},
                                               EstimateSample{.has_outlier = true}};
  EXPECT_DOUBLE_EQ(*quality_of(samples).outliers_found, 0.25);
  EXPECT_DOUBLE_EQ(*quality_of(samples).outliers_farthest, 0.5);
  EXPECT_DOUBLE_EQ(*quality_of(samples).outliers_suspected, 0.25);
}

TEST(EstimateStudy, RejectsFactorsThatAreOutOfOrder) {
  EXPECT_THROW(disturb(straight_trajectory(3), {.least_factor = 2, .most_factor = 1}, 0), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
