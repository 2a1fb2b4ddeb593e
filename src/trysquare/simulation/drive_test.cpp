// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/drive.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trysquare {
namespace {

const SimulatedWorld kLine{.mesh = {}, .route_in_world = {{0, 0, 1.8}, {60, 0, 1.8}}};
const SimulatedWorld kSquare{
    .mesh = {}, .route_in_world = {{0, 0, 0}, {50, 0, 0}, {50, 50, 0}, {0, 50, 0}}, .route_is_loop = true};
constexpr DriveSettings kSteady{.sway_m = 0, .heave_sigma_m = 0, .tilt_sigma_rad = 0};

DriveSettings with(DriveSettings settings, std::size_t num_scans, std::uint64_t seed = 0) {
  settings.num_scans = num_scans;
  settings.seed = seed;
  return settings;
}

TEST(Drive, FollowsTheRouteInStepsThatVaryByATenth) {
  const Trajectory trajectory = drive(kLine, with(kSteady, 40));
  ASSERT_EQ(trajectory.size(), 40U);
  EXPECT_EQ(trajectory.world_from_scan[0].translation, Eigen::Vector3d(0, 0, 1.8));
  double shortest = 2;
  double longest = 0;
  for (std::size_t i = 1; i < 40; ++i) {
    const Eigen::Vector3d step =
        trajectory.world_from_scan[i].translation - trajectory.world_from_scan[i - 1].translation;
    EXPECT_LT(step.tail<2>().norm(), 1e-12);
    shortest = std::min(shortest, step.x());
    longest = std::max(longest, step.x());
    EXPECT_EQ(trajectory.stamps_ns[i], static_cast<std::int64_t>(i) * 100'000'000);
  }
  EXPECT_GE(shortest, 0.9);
  EXPECT_LE(longest, 1.1);
  EXPECT_GT(longest - shortest, 0.1);
}

TEST(Drive, LooksAheadAroundCornersWithRotationsThatAreRotations) {
  const Trajectory trajectory = drive(kSquare, with(kSteady, 150));
  double largest_turn = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const Pose& pose = trajectory.world_from_scan[i];
    EXPECT_LT(rotation_error(pose.rotation), 1e-13);
    EXPECT_LT(std::abs(pose.rotation(2, 0)), 1e-12);
    const Eigen::Vector3d step = pose.translation - trajectory.world_from_scan[i - 1].translation;
    EXPECT_GT(pose.rotation.col(0).dot(step.normalized()), 0.6) << i;
    const double cosine = pose.rotation.col(0).dot(trajectory.world_from_scan[i - 1].rotation.col(0));
    largest_turn = std::max(largest_turn, std::acos(std::min(1.0, cosine)));
  }
  EXPECT_GT(largest_turn, 0.3);
}

TEST(Drive, GoesOnAndOnAroundALoop) {
  const Trajectory trajectory = drive(kSquare, with(kSteady, 500));
  for (const Pose& pose : trajectory.world_from_scan) {
    const Eigen::Vector2d from_middle = pose.translation.head<2>() - Eigen::Vector2d(25, 25);
    EXPECT_NEAR(from_middle.lpNorm<Eigen::Infinity>(), 25, 1e-9);
  }
  EXPECT_TRUE(std::isinf(length_of_route_m(kSquare)));
}

TEST(Drive, RefusesToLeaveTheEndOfARoute) {
  EXPECT_NEAR(length_of_route_m(kLine), 60, 1e-12);
  EXPECT_NO_THROW(drive(kLine, with({}, 54)));
  EXPECT_THROW(drive(kLine, with({}, 70)), InvalidArgument);
  EXPECT_THROW(drive(SimulatedWorld{}, {}), InvalidArgument);
}

TEST(Drive, TheBeginningOfALongDriveIsTheShortOne) {
  const Trajectory small = drive(kSquare, with({}, 10, 3));
  const Trajectory large = drive(kSquare, with({}, 30, 3));
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(small.world_from_scan[i].rotation, large.world_from_scan[i].rotation);
    EXPECT_EQ(small.world_from_scan[i].translation, large.world_from_scan[i].translation);
  }
  EXPECT_NE(drive(kSquare, with({}, 10, 4)).world_from_scan[5].translation, small.world_from_scan[5].translation);
}

TEST(Drive, WobblesAsMuchAsAsked) {
  const Trajectory trajectory =
      drive(kSquare, {.num_scans = 4000, .step_m = 0.05, .sway_m = 0, .heave_sigma_m = 0.02, .tilt_sigma_rad = 0.005});
  double heave = 0;
  double tilt = 0;
  for (const Pose& pose : trajectory.world_from_scan) {
    heave += pose.translation.z() * pose.translation.z();
    tilt += pose.rotation.col(2).head<2>().squaredNorm() / 2;  // roll and pitch
  }
  EXPECT_NEAR(heave / 4000 / (0.02 * 0.02), 1, 5 * std::sqrt(2.0 / 4000));
  EXPECT_NEAR(tilt / 4000 / (0.005 * 0.005), 1, 5 * std::sqrt(2.0 / 8000));
}

TEST(Drive, SwaysToBothSidesWithinTheBound) {
  double left = 0;
  double right = 0;
  for (const Pose& pose : drive(kLine, {.num_scans = 50, .sway_m = 0.3}).world_from_scan) {
    left = std::max(left, pose.translation.y());
    right = std::min(right, pose.translation.y());
  }
  EXPECT_LE(left, 0.3);
  EXPECT_GE(right, -0.3);
  EXPECT_GT(left - right, 0.2);
}

TEST(Drive, TurnsTheSensorAsItIsMounted) {
  DriveSettings settings = kSteady;
  settings.look_left_rad = 0.5;
  settings.look_down_rad = 0.2;
  const Eigen::Vector3d forward = drive(kLine, settings).world_from_scan[3].rotation.col(0);
  EXPECT_NEAR(std::atan2(forward.y(), forward.x()), 0.5, 1e-12);
  EXPECT_NEAR(std::asin(forward.z()), -0.2, 1e-12);
}

TEST(Drive, RefusesSettingsOutOfRange) {
  EXPECT_THROW(drive(kLine, {.num_scans = 0}), InvalidArgument);
  EXPECT_THROW(drive(kLine, {.step_m = 0}), InvalidArgument);
  EXPECT_THROW(drive(kLine, {.period_s = -1}), InvalidArgument);
  EXPECT_THROW(drive(kLine, {.sway_m = -1}), InvalidArgument);
  EXPECT_THROW(drive(kLine, {.heave_sigma_m = -1}), InvalidArgument);
  EXPECT_THROW(drive(kLine, {.tilt_sigma_rad = std::numeric_limits<double>::quiet_NaN()}), InvalidArgument);
  EXPECT_THROW(drive(kLine, {.look_down_rad = 2}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
