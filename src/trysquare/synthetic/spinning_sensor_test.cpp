// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/spinning_sensor.h"

#include "trysquare/core/error.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trysquare {
namespace {

const std::vector<Rectangle> kRoom = box({-4, -5, -1}, {10, 8, 3});

Scan scan_room(const SpinningSensor& sensor, const Pose& world_from_scan = {}) {
  Random random(7);
  return cast_scan(kRoom, world_from_scan, sensor, random);
}

/// Distance from a point to the nearest plane of the room.
double distance_to_room(const Eigen::Vector3d& p) {
  return std::min({std::abs(p.x() + 4), std::abs(p.x() - 6), std::abs(p.y() + 5), std::abs(p.y() - 3),
                   std::abs(p.z() + 1), std::abs(p.z() - 2)});
}

TEST(CastScan, OfAClosedRoomHasAPointForEveryRay) {
  EXPECT_EQ(scan_room({.num_beams = 8, .num_azimuths = 90}).points_in_scan.size(), 720u);
}

TEST(CastScan, WithoutNoiseEveryPointLiesOnASurfaceForEveryPose) {
  const Pose pose{Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix(), {1, -0.5, 0.3}};
  for (const Eigen::Vector3d& point : scan_room({.range_sigma_m = 0}, pose).points_in_scan) {
    ASSERT_LT(distance_to_room(pose * point), 1e-14);
  }
}

TEST(CastScan, BeamsSpanTheVerticalFieldOfViewEvenly) {
  const Scan scan =
      scan_room({.num_beams = 3, .num_azimuths = 4, .lowest_elevation_rad = -0.3, .highest_elevation_rad = 0.5});
  ASSERT_EQ(scan.points_in_scan.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    const Eigen::Vector3d& p = scan.points_in_scan[i];
    EXPECT_NEAR(std::atan2(p.z(), p.head<2>().norm()), -0.3 + 0.4 * static_cast<double>(i / 4), 1e-14);
    EXPECT_NEAR(std::cos(std::atan2(p.y(), p.x()) - std::acos(-1.0) / 2 * static_cast<double>(i % 4)), 1, 1e-14);
  }
}

TEST(CastScan, NoiseLiesAlongTheRayAndHasTheRequestedSize) {
  const Scan truth = scan_room({.range_sigma_m = 0});
  const Scan noisy = scan_room({.range_sigma_m = 0.02});
  ASSERT_EQ(noisy.points_in_scan.size(), truth.points_in_scan.size());
  double sum = 0;
  for (std::size_t i = 0; i < truth.points_in_scan.size(); ++i) {
    const Eigen::Vector3d& p = truth.points_in_scan[i];
    const Eigen::Vector3d& q = noisy.points_in_scan[i];
    ASSERT_LT(p.normalized().cross(q).norm(), 1e-14);
    sum += (q.norm() - p.norm()) * (q.norm() - p.norm());
  }
  const double n = static_cast<double>(truth.points_in_scan.size());
  EXPECT_NEAR(sum / n / (0.02 * 0.02), 1, 5 * std::sqrt(2 / n));
}

TEST(CastScan, LosesReturnsOutOfRange) {
  for (const Eigen::Vector3d& point : scan_room({.min_range_m = 3.5, .max_range_m = 5}).points_in_scan) {
    ASSERT_GT(point.norm(), 3.5);
    ASSERT_LT(point.norm(), 5);
  }
  EXPECT_FALSE(scan_room({.min_range_m = 3.5, .max_range_m = 5}).points_in_scan.empty());
}

TEST(CastScan, ASurfaceHidesWhatIsBehindIt) {
  std::vector<Rectangle> scene{
      {{5, -9, -9}, {0, 18, 0}, {0, 0, 18}}};  // seen from the origin, the next one hides all of it
  scene.push_back({{2, -9, -9}, {0, 18, 0}, {0, 0, 18}});
  Random random(0);
  const Scan scan = cast_scan(scene, {}, {.range_sigma_m = 0}, random);
  ASSERT_FALSE(scan.points_in_scan.empty());
  for (const Eigen::Vector3d& point : scan.points_in_scan) {
    ASSERT_NEAR(point.x(), 2, 1e-14);
  }
}

TEST(SpinningSensor, RefusesSettingsOutOfRange) {
  EXPECT_THROW(scan_room({.num_beams = 0}), InvalidArgument);
  EXPECT_THROW(scan_room({.num_azimuths = 0}), InvalidArgument);
  EXPECT_THROW(scan_room({.lowest_elevation_rad = -2}), InvalidArgument);
  EXPECT_THROW(scan_room({.highest_elevation_rad = 2}), InvalidArgument);
  EXPECT_THROW(scan_room({.min_range_m = -1}), InvalidArgument);
  EXPECT_THROW(scan_room({.min_range_m = 5, .max_range_m = 5}), InvalidArgument);
  EXPECT_THROW(scan_room({.range_sigma_m = -1}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
