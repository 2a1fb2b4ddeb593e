// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/pose_blame.h"

#include "trysquare/adjustment/suspect_poses.h"
#include "trysquare/synthetic/perturb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace trysquare {
namespace {

using testing::IsEmpty;

constexpr std::size_t kNumPoses = 12;

Trajectory straight_drive() {
  Trajectory drive;
  for (std::size_t i = 0; i < kNumPoses; ++i) {
    drive.world_from_scan.push_back({Eigen::Matrix3d::Identity(), {static_cast<double>(i), 0, 0}});
  }
  return drive;
}

/// What an estimate says of `given` when the drive was straight.
RpeEstimate estimate_of(const Trajectory& given, double half_difference_m = 0.005) {
  RpeEstimate estimate{.status = EstimateStatus::kMeasured, .adjusted = straight_drive()};
  estimate.half_difference_m = half_difference_m;
  estimate.half_difference_rad = 1e-4;
  for (const PoseDeviation& deviation : deviations_of_poses(given.world_from_scan, estimate.adjusted.world_from_scan)) {
    estimate.poses.push_back({.deviation = deviation, .sigma_m = 0.002, .sigma_rad = 1e-4, .num_observations = 100});
  }
  return estimate;
}

Trajectory noisy_drive(double sigma_m = 0.002) {
  return perturb(straight_drive(), {.translation_sigma_m = sigma_m, .seed = 5});
}

TEST(FindSuspects, PutTheLargestErrorFirstWithItsInterval) {
  Trajectory given = noisy_drive();
  given.world_from_scan[3].translation.y() += 0.05;
  given.world_from_scan[8].translation.z() += 0.1;
  const SuspectPoses found = find_suspects(given, estimate_of(given));
  ASSERT_EQ(found.poses.size(), 2U);
  EXPECT_EQ(found.poses[0].scan, 8U);
  EXPECT_NEAR(found.poses[0].translation_m, 0.1, 0.01);
  EXPECT_NEAR(found.poses[0].translation_interval_m[0], found.poses[0].translation_m - 0.004, 1e-12);
  EXPECT_NEAR(found.poses[0].translation_interval_m[1], found.poses[0].translation_m + 0.004, 1e-12);
  EXPECT_EQ(found.poses[1].scan, 3U);
}

TEST(FindSuspects, LeaveOutWhatTheEstimateDoesNotKnow) {
  Trajectory given = noisy_drive(0.0002);
  given.world_from_scan[3].translation.y() += 0.008;  // ten times what is usual, but less than 1 cm
  ASSERT_TRUE(estimate_of(given).poses[3].deviation.suspect);
  EXPECT_THAT(find_suspects(given, estimate_of(given)).poses, IsEmpty());
  given.world_from_scan[3].translation.y() += 0.04;  // two halves of the patches differ by more
  EXPECT_EQ(find_suspects(given, estimate_of(given)).poses.size(), 1U);
  EXPECT_THAT(find_suspects(given, estimate_of(given, 0.03)).poses, IsEmpty());
}

TEST(FindSuspects, TellADriftFromAJump) {
  Trajectory drifting = noisy_drive();
  Trajectory jumping = noisy_drive();
  for (std::size_t i = 0; i < 4; ++i) {
    drifting.world_from_scan[i].translation.y() += 0.05 * static_cast<double>(4 - i);
    jumping.world_from_scan[i].translation.y() += 0.2;
  }
  const SuspectPoses drift = find_suspects(drifting, estimate_of(drifting));
  EXPECT_THAT(drift.poses, IsEmpty());
  ASSERT_EQ(drift.groups.size(), 1U);
  EXPECT_TRUE(drift.groups[0].is_drift);
  const SuspectPoses jump = find_suspects(jumping, estimate_of(jumping));
  EXPECT_THAT(jump.poses, IsEmpty());
  ASSERT_EQ(jump.groups.size(), 1U);
  EXPECT_FALSE(jump.groups[0].is_drift);
  EXPECT_EQ(jump.groups[0].first, 0U);
  EXPECT_EQ(jump.groups[0].last, 3U);
}

TEST(FindSuspects, FindNoneInARefusedEstimate) {
  EXPECT_THAT(find_suspects(noisy_drive(), RpeEstimate{}).poses, IsEmpty());
}

TEST(FindJumps, NameTheStepAfterWhichAllPosesAreOff) {
  Trajectory given = noisy_drive();
  for (std::size_t i = 7; i < kNumPoses; ++i) given.world_from_scan[i].translation.y() += 0.1;
  const RpeEstimate estimate = estimate_of(given);
  const std::vector<PoseJump> jumps = find_jumps(given, estimate, find_suspects(given, estimate).poses);
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_EQ(jumps[0].from, 6U);
  EXPECT_NEAR(jumps[0].translation_m, 0.1, 0.01);
  EXPECT_EQ(jumps[0].limit_m, 0.03);
}

TEST(FindJumps, LeaveTheStepsOfASingleSuspectToIt) {
  Trajectory given = noisy_drive();
  given.world_from_scan[5].translation.y() += 0.1;
  const RpeEstimate estimate = estimate_of(given);
  EXPECT_THAT(find_jumps(given, estimate, find_suspects(given, estimate).poses), IsEmpty());
  EXPECT_EQ(find_jumps(given, estimate, {}).size(), 2U) << "unless it is none";
}

TEST(FindJumps, FindNoneWhereAllStepsAreOffAlike) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Trajectory given = perturb(straight_drive(), {.translation_sigma_m = 0.05, .seed = seed});
    EXPECT_THAT(find_jumps(given, estimate_of(given), {}), IsEmpty()) << "seed " << seed;
  }
}

TEST(FindPosesOffPath, NameThePoseAndNotItsNeighbors) {
  Trajectory given = noisy_drive(0.02);
  given.world_from_scan[5].translation.y() += 2;
  const std::vector<PoseOffPath> found = find_poses_off_path(given);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].scan, 5U);
  EXPECT_NEAR(found[0].distance_m, 2, 0.1);
  EXPECT_THAT(find_poses_off_path(noisy_drive(0.1)), IsEmpty());
}

}  // namespace
}  // namespace trysquare
