// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/error_by_length.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/rpe.h"
#include "trysquare/trajectory/trajectory_test_examples.h"

#include <gtest/gtest.h>

namespace trysquare {
namespace {

using test::disturbed;
using test::winding;

Trajectory straight(double metres_per_pose) {
  Trajectory trajectory;
  for (int i = 0; i <= 100; ++i) trajectory.world_from_scan.push_back({.translation = {metres_per_pose * i, 0, 0}});
  return trajectory;
}

TEST(ErrorByLength, OfAScaleErrorIsTheSamePercentageAtEveryLength) {
  const auto errors = error_by_length(straight(1), straight(1.03), {.relative_tolerance = 1e-9});
  ASSERT_EQ(errors.size(), 5u);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_DOUBLE_EQ(errors[i].length_m, 10.0 * static_cast<double>(i + 1));
    EXPECT_NEAR(errors[i].translation_percent.value().mean, 3, 1e-9);
    EXPECT_NEAR(errors[i].translation_m.value().max, 0.03 * errors[i].length_m, 1e-12);
    EXPECT_EQ(errors[i].translation_m.value().count, 101 - 10 * (i + 1));
  }
}

TEST(ErrorByLength, IsTheRelativeErrorOfThePairsOnTheReference) {
  const Trajectory reference = winding(80);
  const Trajectory estimate = disturbed(reference);
  const auto errors = error_by_length(reference, estimate, {.lengths_m = {3}, .relative_tolerance = 0.1});
  const TrajectoryErrors expected =
      rpe(reference, estimate,
          {.pairs = {.delta = 3, .unit = DeltaUnit::kMetres, .relative_tolerance = 0.1, .all_pairs = true},
           .pairs_from_reference = true});
  EXPECT_EQ(errors.at(0).translation_m.value().rmse, expected.statistics.rmse);
}

TEST(ErrorByLength, IsUndefinedWhereNothingIsThatLong) {
  const auto errors = error_by_length(straight(1), straight(1), {.lengths_m = {50, 500}});
  EXPECT_TRUE(errors.at(0).rotation_rad.has_value());
  EXPECT_FALSE(errors.at(1).rotation_rad.has_value());
  EXPECT_FALSE(errors.at(1).reason.empty());
}

TEST(ErrorByLength, RefusesSettingsOutOfRangeAndAReferenceThatStands) {
  EXPECT_THROW(error_by_length(straight(0), straight(1)), InvalidArgument);
  EXPECT_THROW(error_by_length(straight(1), straight(1), {.lengths_m = {-1}}), InvalidArgument);
  EXPECT_THROW(error_by_length(straight(1), straight(1), {.shares = {1.5}}), InvalidArgument);
  EXPECT_THROW(error_by_length(straight(1), straight(1), {.shares = {}}), InvalidArgument);
  EXPECT_THROW(error_by_length(straight(1), straight(1), {.relative_tolerance = -1}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
