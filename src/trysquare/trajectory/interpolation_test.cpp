// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/interpolation.h"

#include "trysquare/core/error.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trysquare {
namespace {

using Place = PoseInterpolator::Place;

constexpr std::int64_t kSecond = 1'000'000'000;

Pose turned(double angle_rad, const Eigen::Vector3d& translation = Eigen::Vector3d::Zero()) {
  return {Eigen::AngleAxisd(angle_rad, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix(), translation};
}

TEST(Interpolated, TurnsAtConstantSpeedAndMovesOnALine) {
  const Pose middle = interpolated(turned(0.2, {1, 0, 0}), turned(1.4, {3, -4, 8}), 0.25);
  EXPECT_LT((middle.rotation - turned(0.5).rotation).norm(), 1e-15);
  EXPECT_LT((middle.translation - Eigen::Vector3d(1.5, -1, 2)).norm(), 1e-15);
}

TEST(Interpolated, TakesTheShorterWayAround) {
  const Pose middle = interpolated(turned(-3.0), turned(3.0), 0.5);  // 6 rad apart one way, 0.28 the other
  EXPECT_LT((middle.rotation - turned(std::acos(-1.0)).rotation).norm(), 1e-14);
}

TEST(Interpolated, GivesTheEndsAsTheyAre) {
  Pose a = turned(0.3);
  a.rotation(0, 0) += 1e-7;  // as files have it
  EXPECT_EQ(interpolated(a, turned(1), 0).rotation, a.rotation);
  EXPECT_EQ(interpolated(turned(1), a, 1).rotation, a.rotation);
}

TEST(PoseInterpolator, FindsTheTwoNeighborsInAnyOrderOfTheStamps) {
  const Trajectory trajectory{
      {turned(0, {20, 0, 0}), turned(0, {0, 0, 0}), turned(0, {10, 0, 0}), turned(0, {99, 0, 0})},
      {2 * kSecond, 0, kSecond, kSecond}};
  const PoseInterpolator poses(trajectory);
  EXPECT_DOUBLE_EQ(poses.at(kSecond / 2, kSecond).world_from_scan.translation.x(), 5);
  EXPECT_DOUBLE_EQ(poses.at(kSecond * 7 / 4, kSecond).world_from_scan.translation.x(), 17.5);
  EXPECT_EQ(poses.at(kSecond, 0).world_from_scan.translation.x(), 10) << "of equal stamps the first counts";
  EXPECT_EQ(poses.at(kSecond * 7 / 4, kSecond).nearest_ns, 2 * kSecond);
}

TEST(PoseInterpolator, NeverExtrapolatesAndCrossesNoGap) {
  const PoseInterpolator poses({{turned(0), turned(1)}, {0, 2 * kSecond}});
  EXPECT_EQ(poses.at(-1, kSecond).place, Place::kOutside);
  EXPECT_EQ(poses.at(2 * kSecond + 1, kSecond).place, Place::kOutside);
  EXPECT_EQ(poses.at(kSecond, kSecond).place, Place::kInGap);
  EXPECT_EQ(poses.at(kSecond, 2 * kSecond).place, Place::kInside) << "the largest gap is inclusive";
  EXPECT_EQ(poses.at(2 * kSecond, 0).place, Place::kInside) << "at a pose no gap matters";
}

TEST(PoseInterpolator, StampsAtTheEndsOf64BitsWork) {
  const std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
  const std::int64_t highest = std::numeric_limits<std::int64_t>::max();
  const PoseInterpolator poses({{turned(0), turned(1)}, {lowest, highest}});
  EXPECT_EQ(poses.at(0, highest).place, Place::kInGap);
  EXPECT_EQ(poses.at(highest, 0).place, Place::kInside);
}

TEST(PoseInterpolator, RefusesATrajectoryWithoutStamps) {
  EXPECT_THROW(PoseInterpolator({{turned(0)}, {}}), InvalidArgument);
  EXPECT_THROW(PoseInterpolator(Trajectory{}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
