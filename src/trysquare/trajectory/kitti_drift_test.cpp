// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/kitti_drift.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/trajectory_test_examples.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <numbers>

namespace trysquare {
namespace {

/// A straight drive of 1 m per pose.
Trajectory straight(std::size_t num_poses, double metres_per_pose = 1) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < num_poses; ++i) {
    trajectory.world_from_scan.push_back({.translation = {metres_per_pose * static_cast<double>(i), 0, 0}});
  }
  return trajectory;
}

TEST(KittiDrift, OfAScaleErrorIsThatErrorOverTheFirstPoseBeyondTheLength) {
  const KittiDrift drift = kitti_drift(straight(151), straight(151, 1.02));
  ASSERT_TRUE(drift.mean.has_value());
  // Of 0, 10, ..., 40 (from 50 on no pose is *more* than 100 m further): 101 m, off by 2.02 m, over 100 m.
  EXPECT_EQ(drift.mean->num_segments, 5u);
  EXPECT_NEAR(drift.mean->translation_percent, 2.02, 1e-12);
  EXPECT_EQ(drift.mean->rotation_deg_per_100m, 0);
  ASSERT_EQ(drift.by_length.size(), 8u);
  EXPECT_FALSE(drift.by_length[1].drift.has_value());
  EXPECT_EQ(drift.path_length_m, 150);
}

TEST(KittiDrift, OfASlowTurnIsItsAngleOver100Metres) {
  Trajectory estimate = straight(121);
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const double angle_rad = 1e-3 * static_cast<double>(i);
    estimate.world_from_scan[i].rotation = Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
  const KittiDrift drift = kitti_drift(straight(121), estimate);
  EXPECT_NEAR(drift.mean->rotation_deg_per_100m, 0.101 * 180 / std::numbers::pi, 1e-9);
}

TEST(KittiDrift, TheMeanIsOverSegmentsNotOverLengths) {
  const Trajectory reference = straight(301);
  Trajectory estimate = straight(301);
  for (std::size_t i = 250; i < 301; ++i) estimate.world_from_scan[i].translation.y() = 3;
  const KittiDrift drift = kitti_drift(reference, estimate, {.lengths_m = {100, 200}});
  // Ends beyond 250: of 100 m starts 150..190 (5 of 20), of 200 m starts 50..90 (5 of 10).
  EXPECT_EQ(drift.by_length[0].drift->num_segments, 20u);
  EXPECT_NEAR(drift.by_length[0].drift->translation_percent, 3.0 * 5 / 20, 1e-12);
  EXPECT_NEAR(drift.by_length[1].drift->translation_percent, 1.5 * 5 / 10, 1e-12);
  EXPECT_NEAR(drift.mean->translation_percent, (3.0 * 5 + 1.5 * 5) / 30, 1e-12);
}

TEST(KittiDrift, IsUndefinedOnAShortPathAndSaysWhy) {
  const KittiDrift drift = kitti_drift(straight(101), straight(101));
  EXPECT_FALSE(drift.mean.has_value());
  EXPECT_NE(drift.reason.find("100 m"), std::string::npos);
}

TEST(KittiDrift, RefusesSettingsOutOfRangeAndOtherCounts) {
  EXPECT_THROW(kitti_drift(straight(5), straight(4)), InvalidArgument);
  EXPECT_THROW(kitti_drift(straight(5), straight(5), {.lengths_m = {}}), InvalidArgument);
  EXPECT_THROW(kitti_drift(straight(5), straight(5), {.lengths_m = {0}}), InvalidArgument);
  EXPECT_THROW(kitti_drift(straight(5), straight(5), {.lengths_m = {2, 1}}), InvalidArgument);
  EXPECT_THROW(kitti_drift(straight(5), straight(5), {.step = 0}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
