// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/time_offset.h"

#include "trysquare/core/error.h"
#include "trysquare/synthetic/perturb.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace trysquare {
namespace {

using testing::HasSubstr;

Pose weaving(double time_s) {
  return {.rotation = Eigen::AngleAxisd(0.2 * std::sin(2 * time_s), Eigen::Vector3d::UnitZ()).toRotationMatrix(),
          .translation = {5 * time_s + 0.5 * time_s * time_s, std::sin(time_s), 0}};
}

/// A circle at constant speed.
Pose steady(double time_s) {
  const double heading = 0.3 * time_s;
  return {.rotation = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
          .translation = {20 * std::sin(heading), 20 * (1 - std::cos(heading)), 0}};
}

/// Poses every `step_s` from `begin_s` on, stamped with the time of the motion plus `late_s`.
Trajectory sampled(Pose (*motion)(double), double begin_s, double step_s, std::size_t count, double late_s = 0) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < count; ++i) {
    const double time_s = begin_s + step_s * static_cast<double>(i);
    trajectory.world_from_scan.push_back(motion(time_s));
    trajectory.stamps_ns.push_back(std::llround(1e9 * (time_s + late_s)));
  }
  return trajectory;
}

TEST(FindTimeOffset, IsTheOffsetOfTheClocksToAMillisecond) {
  const Trajectory truth = sampled(weaving, 1, 0.1, 20);
  for (const double late_s : {-0.08, 0.013, 0.05}) {
    const Trajectory poses = sampled(weaving, 0, 0.01, 400, late_s);  // at 100 Hz, by another clock
    const TimeOffset found = find_time_offset(poses, truth.stamps_ns, truth);
    ASSERT_TRUE(found.offset_s) << found.reason;
    EXPECT_NEAR(*found.offset_s, late_s, 0.001);
    EXPECT_EQ(found.num_scans, 20U);
    EXPECT_EQ(found.costs.size(), 17U);
  }
}

TEST(FindTimeOffset, ResolvesWhereTheSquaredErrorHasDoubled) {
  const Trajectory truth = sampled(weaving, 1, 0.1, 20);
  const Trajectory adjusted = perturb(truth, {.translation_sigma_m = 0.01, .seed = 2});
  const Trajectory poses = sampled(weaving, 0, 0.01, 400, 0.05);
  const TimeOffset found = find_time_offset(poses, truth.stamps_ns, adjusted);
  ASSERT_TRUE(found.offset_s && found.resolution_s) << found.reason;
  EXPECT_NEAR(*found.offset_s, 0.05, *found.resolution_s);
  // Moved by the resolution, poses of which nothing else is wrong show the error that was left at the best offset.
  const Trajectory moved = sampled(weaving, 0, 0.01, 400, *found.resolution_s);
  const TimeOffset of_moved = find_time_offset(moved, truth.stamps_ns, truth);
  EXPECT_NEAR(of_moved.costs[8].error_m / found.best.value().error_m, 1, 0.1);
}

TEST(FindTimeOffset, SaysThatSteadyMotionHidesIt) {
  const Trajectory truth = sampled(steady, 1, 0.1, 20);
  const TimeOffset found = find_time_offset(sampled(steady, 0, 0.01, 400, 0.05), truth.stamps_ns, truth);
  EXPECT_FALSE(found.offset_s);
  EXPECT_LT(found.costs.front().error_m, 0.001) << "a shift moves the whole map";
}

TEST(FindTimeOffset, DoesNotExplainRandomErrors) {
  const Trajectory truth = sampled(weaving, 1, 0.1, 20);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Trajectory poses = perturb(truth, {.translation_sigma_m = 0.05, .rotation_sigma_rad = 0.003, .seed = seed});
    const TimeOffset found = find_time_offset(poses, truth.stamps_ns, truth);
    EXPECT_FALSE(found.offset_s) << "seed " << seed;
    EXPECT_THAT(found.reason, HasSubstr("no offset explains"));
  }
}

TEST(FindTimeOffset, LeavesOutScansAtTheEndsAndSaysWhenFewRemain) {
  const Trajectory truth = sampled(weaving, 1, 0.1, 9);
  const TimeOffset found = find_time_offset(truth, truth.stamps_ns, truth);
  EXPECT_EQ(found.num_scans, 5U);  // two at either end are nearer to it than 0.2 s
  EXPECT_THAT(found.reason, HasSubstr("5 scans have poses"));
  EXPECT_EQ(find_time_offset(truth, truth.stamps_ns, truth, 0.1).num_scans, 7U);
}

TEST(FindTimeOffset, RefusesCountsThatDiffer) {
  const Trajectory truth = sampled(weaving, 1, 0.1, 9);
  const std::vector<std::int64_t> stamps_ns(8);
  EXPECT_THROW(find_time_offset(truth, stamps_ns, truth), InvalidArgument);
  EXPECT_THROW(find_time_offset(truth, truth.stamps_ns, truth, 0), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
