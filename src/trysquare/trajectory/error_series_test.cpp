// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/error_series.h"

#include "trysquare/trajectory/ape.h"
#include "trysquare/trajectory/rpe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using testing::ElementsAre;

/// Places 0, 1, 3, 6 m on a line, half a second apart; the estimate is twice as long.
Trajectory run(double scale) {
  Trajectory trajectory;
  for (const double x : {0.0, 1.0, 3.0, 6.0}) trajectory.world_from_scan.push_back({.translation = {scale * x, 0, 0}});
  trajectory.stamps_ns = {10'000'000'000, 10'500'000'000, 11'000'000'000, 11'500'000'000};
  return trajectory;
}

TEST(ErrorSeries, OfApeHasTheTimesAndPathsOfAllPoses) {
  const ErrorSeries series = error_series(ape(run(1), run(2)), run(1), run(2));
  EXPECT_THAT(series.stamps_s, ElementsAre(10, 10.5, 11, 11.5));
  EXPECT_THAT(series.seconds_from_start, ElementsAre(0, 0.5, 1, 1.5));
  EXPECT_THAT(series.reference_distances_m, ElementsAre(0, 1, 3, 6));
  EXPECT_THAT(series.estimate_distances_m, ElementsAre(0, 2, 6, 12));
  EXPECT_EQ(series.positions_in_reference_world.at(3), Eigen::Vector3d(12, 0, 0));
}

TEST(ErrorSeries, OfRpeHasThoseOfTheSecondPoseOfEachPair) {
  const TrajectoryErrors errors = rpe(run(1), run(2), {.pairs = {.delta = 2, .all_pairs = true}});
  const ErrorSeries series = error_series(errors, run(1), run(2));
  EXPECT_THAT(series.seconds_from_start, ElementsAre(1, 1.5));
  EXPECT_THAT(series.stamps_s, ElementsAre(11, 11.5));
  EXPECT_THAT(series.reference_distances_m, ElementsAre(3, 6));
  EXPECT_EQ(series.positions_in_reference_world.size(), 2u);
}

TEST(ErrorSeries, WithoutTimeStampsHasNoTimes) {
  Trajectory estimate = run(2);
  estimate.stamps_ns.clear();
  const ErrorSeries series = error_series(ape(run(1), estimate), run(1), estimate, Plane::kYz);
  EXPECT_TRUE(series.stamps_s.empty());
  EXPECT_TRUE(series.seconds_from_start.empty());
  EXPECT_THAT(series.reference_distances_m, ElementsAre(0, 0, 0, 0)) << "projected along its only direction";
}

TEST(ComparedTrajectories, AreAlignedAndOfRpeHoldTheFirstPoseAndTheSecondOfEachPair) {
  Trajectory moved = run(2);
  for (Pose& pose : moved.world_from_scan) pose.translation.y() += 7;
  const TrajectoryErrors errors = rpe(run(1), moved, {.pairs = {.delta = 2}, .alignment = Alignment::kOrigin});
  const ComparedTrajectories compared = compared_trajectories(errors, run(1), moved);
  EXPECT_THAT(compared.reference.stamps_ns, ElementsAre(10'000'000'000, 11'000'000'000));
  EXPECT_EQ(compared.reference.world_from_scan.at(1).translation, Eigen::Vector3d(3, 0, 0));
  EXPECT_EQ(compared.estimate.world_from_scan.at(1).translation, Eigen::Vector3d(6, 0, 0));
}

TEST(ComparedTrajectories, OfApeAreAllPosesProjectedAsAsked) {
  const ComparedTrajectories compared = compared_trajectories(ape(run(1), run(2)), run(1), run(2), Plane::kYz);
  EXPECT_EQ(compared.reference.size(), 4u);
  EXPECT_EQ(compared.estimate.world_from_scan.at(3).translation, Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace trysquare
