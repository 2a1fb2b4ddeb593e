// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/all_pairs_rpe.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/rpe.h"
#include "trysquare/trajectory/trajectory_test_examples.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trysquare {
namespace {

using test::disturbed;
using test::winding;

/// Errors of all pairs i < j from rpe(), one distance in frames after the other.
ErrorStatistics from_rpe(const Trajectory& reference, const Trajectory& estimate, PoseRelation relation) {
  std::vector<double> errors;
  for (std::size_t delta = 1; delta < reference.size(); ++delta) {
    const auto of_delta = rpe(
        reference, estimate, {.relation = relation, .pairs = {.delta = static_cast<double>(delta), .all_pairs = true}});
    errors.insert(errors.end(), of_delta.errors.begin(), of_delta.errors.end());
  }
  return error_statistics(errors);
}

void expect_equal(const ErrorStatistics& actual, const ErrorStatistics& expected) {
  EXPECT_EQ(actual.count, expected.count);
  EXPECT_NEAR(actual.rmse / expected.rmse, 1, 1e-13);
  EXPECT_NEAR(actual.mean / expected.mean, 1, 1e-13);
  EXPECT_NEAR(actual.median / expected.median, 1, 1e-13);
  EXPECT_NEAR(actual.std, expected.std, 1e-13 * expected.mean);
  EXPECT_NEAR(actual.min, expected.min, 1e-13 * expected.mean);
  EXPECT_NEAR(actual.max / expected.max, 1, 1e-13);
  EXPECT_NEAR(actual.sse / expected.sse, 1, 1e-13);
}

TEST(AllPairsRpe, HasTheStatisticsOfTheListOfAllErrors) {
  for (const int n : {2, 3, 4, 5, 60, 61}) {  // odd and even numbers of pairs
    const Trajectory reference = winding(n);
    const Trajectory estimate = disturbed(winding(n));
    const AllPairsRpe result = all_pairs_rpe(reference, estimate);
    expect_equal(result.translation_m, from_rpe(reference, estimate, PoseRelation::kTranslationPart));
    expect_equal(result.rotation_rad, from_rpe(reference, estimate, PoseRelation::kRotationAngleRad));
  }
}

// Files hold six or seven digits: the matrices are no exact rotations, and the products may not be reordered freely.
TEST(AllPairsRpe, MultipliesRawMatricesAsRpeDoes) {
  Trajectory reference = winding(20);
  Trajectory estimate = disturbed(winding(20));
  for (Trajectory* trajectory : {&reference, &estimate}) {
    for (Pose& pose : trajectory->world_from_scan) {
      pose.rotation = (pose.rotation * 1e4).array().round() / 1e4;
      pose.translation *= 100;
    }
  }
  const AllPairsRpe result = all_pairs_rpe(reference, estimate);
  expect_equal(result.translation_m, from_rpe(reference, estimate, PoseRelation::kTranslationPart));
  expect_equal(result.rotation_rad, from_rpe(reference, estimate, PoseRelation::kRotationAngleRad));
}

TEST(AllPairsRpe, IsTheSameForEveryNumberOfThreads) {
  const Trajectory reference = winding(331);
  const Trajectory estimate = disturbed(winding(331));
  const AllPairsRpe one = all_pairs_rpe(reference, estimate, {.num_threads = 1});
  expect_equal(one.translation_m, from_rpe(reference, estimate, PoseRelation::kTranslationPart));
  for (const int num_threads : {2, 3, 8}) {
    const AllPairsRpe several = all_pairs_rpe(reference, estimate, {.num_threads = num_threads});
    EXPECT_EQ(several.translation_m.rmse, one.translation_m.rmse);
    EXPECT_EQ(several.translation_m.median, one.translation_m.median);
    EXPECT_EQ(several.rotation_rad.mean, one.rotation_rad.mean);
    EXPECT_EQ(several.rotation_rad.std, one.rotation_rad.std);
  }
}

TEST(AllPairsRpe, OfEqualTrajectoriesIsZero) {
  const AllPairsRpe result = all_pairs_rpe(disturbed(winding(10), 0.5), disturbed(winding(10), 0.5));
  EXPECT_LT(result.translation_m.max, 1e-14);
  EXPECT_LT(result.rotation_rad.max, 1e-14);
}

TEST(AllPairsRpe, MedianLiesBetweenBinsWhenTheMiddleTwoAreFarApart) {
  Trajectory reference{std::vector<Pose>(4), {}};
  Trajectory estimate = reference;
  estimate.world_from_scan[1].translation.x() = 1;
  estimate.world_from_scan[2].translation.x() = 3;
  estimate.world_from_scan[3].translation.x() = 1000;  // errors 1, 2, 3, 997, 999, 1000
  EXPECT_DOUBLE_EQ(all_pairs_rpe(reference, estimate).translation_m.median, 500);
}

TEST(AllPairsRpe, RefusesFewerThanTwoPosesAndUnequalCounts) {
  EXPECT_THROW(all_pairs_rpe(winding(1), winding(1)), InvalidArgument);
  EXPECT_THROW(all_pairs_rpe(winding(3), winding(4)), InvalidArgument);
  EXPECT_THROW(all_pairs_rpe({}, {}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
