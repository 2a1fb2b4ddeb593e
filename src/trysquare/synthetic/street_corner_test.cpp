// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/street_corner.h"

#include "trysquare/core/error.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace trysquare {
namespace {

StreetCornerSettings small() { return {.num_scans = 3, .sensor = {.num_beams = 16, .num_azimuths = 180}}; }

/// Distance from a point to the nearest rectangle's plane, within its borders up to `margin_m`.
double distance_to_scene(const std::vector<Rectangle>& scene, const Eigen::Vector3d& point, double margin_m) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Rectangle& rectangle : scene) {
    const Eigen::Vector3d at = point - rectangle.corner;
    const double u = at.dot(rectangle.side_u.normalized());
    const double v = at.dot(rectangle.side_v.normalized());
    if (u < -margin_m || u > rectangle.side_u.norm() + margin_m) continue;
    if (v < -margin_m || v > rectangle.side_v.norm() + margin_m) continue;
    nearest = std::min(nearest, std::abs(at.dot(rectangle.normal())));
  }
  return nearest;
}

TEST(StreetCorner, PointsLieOnTheSceneUpToTheNoiseWhenMovedByTheTruePoses) {
  for (const double sigma : {0.0, 0.02}) {
    StreetCornerSettings settings = small();
    settings.sensor.range_sigma_m = sigma;
    const SyntheticSequence street = simulate_street_corner(settings);
    for (std::size_t i = 0; i < street.scans.size(); ++i) {
      const Scan scan = street.scans.load(i);
      ASSERT_GT(scan.points_in_scan.size(), 1000u);
      for (const Eigen::Vector3d& point : scan.points_in_scan) {
        const Eigen::Vector3d point_in_world = street.trajectory.world_from_scan[i] * point;
        ASSERT_LT(distance_to_scene(street_corner_scene(), point_in_world, 6 * sigma + 1e-9), 6 * sigma + 1e-12);
      }
    }
  }
}

TEST(StreetCorner, EverySurfaceThatIsMeantToBeSeenIsSeen) {
  StreetCornerSettings settings;
  settings.sensor.range_sigma_m = 0;
  const SyntheticSequence street = simulate_street_corner(settings);
  const std::vector<Rectangle> scene = street_corner_scene();
  std::vector<std::size_t> counts(scene.size());
  for (std::size_t i = 0; i < street.scans.size(); ++i) {
    for (const Eigen::Vector3d& point : street.scans.load(i).points_in_scan) {
      const Eigen::Vector3d point_in_world = street.trajectory.world_from_scan[i] * point;
      for (std::size_t k = 0; k < scene.size(); ++k)
        counts[k] += distance_to_scene({scene[k]}, point_in_world, 0) < 1e-9;
    }
  }
  for (const std::size_t k : {0u, 1u, 3u, 5u}) EXPECT_GT(counts[k], 10'000u) << "rectangle " << k;
  for (const std::size_t k : {2u, 4u}) EXPECT_GT(counts[k], 1'000u) << "around the corner, rectangle " << k;
  for (const std::size_t car : {6u, 12u}) EXPECT_GT(std::accumulate(&counts[car], &counts[car] + 6, 0u), 1'000u);
}

TEST(StreetCorner, FacadesAreAtRightAnglesToEachOtherAndToTheGround) {
  for (const Rectangle& rectangle : street_corner_scene()) {
    EXPECT_EQ(rectangle.normal().cwiseAbs().maxCoeff(), 1);
    EXPECT_EQ(rectangle.side_u.dot(rectangle.side_v), 0);
  }
}

TEST(StreetCorner, ScansAreTheSameForTheSameSeedAndDifferForAnother) {
  StreetCornerSettings settings = small();
  const auto first = simulate_street_corner(settings).scans.load(2).points_in_scan;
  EXPECT_EQ(simulate_street_corner(settings).scans.load(2).points_in_scan, first);
  settings.num_scans = 5;
  EXPECT_EQ(simulate_street_corner(settings).scans.load(2).points_in_scan, first);
  settings.seed = 1;
  EXPECT_NE(simulate_street_corner(settings).scans.load(2).points_in_scan, first);
}

TEST(StreetCorner, NoiseDiffersFromScanToScan) {
  StreetCornerSettings settings = small();
  settings.step_m = 1e-12;  // both scans see the same
  settings.turn_per_step_rad = 0;
  const MemoryScans scans = simulate_street_corner(settings).scans;
  const Scan first = scans.load(0);
  const Scan second = scans.load(1);
  const std::size_t n = first.points_in_scan.size();
  ASSERT_EQ(second.points_in_scan.size(), n);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += (first.points_in_scan[i] - second.points_in_scan[i]).squaredNorm();
  EXPECT_NEAR(sum / static_cast<double>(n) / (2 * 0.02 * 0.02), 1, 5 * std::sqrt(2 / static_cast<double>(n)));
}

TEST(StreetCorner, DrivesAGentleCurveFromTheOriginWithoutLeavingTheStreet) {
  const Trajectory trajectory = simulate_street_corner({.sensor = {.num_beams = 2, .num_azimuths = 4}}).trajectory;
  ASSERT_EQ(trajectory.size(), 20u);
  EXPECT_EQ(trajectory.world_from_scan[0].translation, Eigen::Vector3d::Zero());
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const Pose& pose = trajectory.world_from_scan[i];
    const Pose& before = trajectory.world_from_scan[i - 1];
    EXPECT_NEAR((pose.translation - before.translation).norm(), 0.8, 1e-14);
    EXPECT_NEAR(Eigen::AngleAxisd(Eigen::Matrix3d(before.rotation.transpose() * pose.rotation)).angle(), 0.01, 1e-14);
    EXPECT_EQ(trajectory.stamps_ns[i] - trajectory.stamps_ns[i - 1], 100'000'000);
    EXPECT_LT(std::abs(pose.translation.y()), 5);
  }
}

TEST(StreetCorner, OfTheDefaultSizeTakesWellUnderASecond) {
  const auto start = std::chrono::steady_clock::now();
  const SyntheticSequence street = simulate_street_corner({});
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  EXPECT_GT(street.scans.load(0).points_in_scan.size(), 12'000u);
  EXPECT_LT(taken.count(), 10);  // 0.2 s when optimised; sanitizers and a busy machine are slower
}

TEST(StreetCorner, RefusesSettingsOutOfRange) {
  EXPECT_THROW(simulate_street_corner({.num_scans = 0}), InvalidArgument);
  EXPECT_THROW(simulate_street_corner({.step_m = 0}), InvalidArgument);
  EXPECT_THROW(simulate_street_corner({.turn_per_step_rad = std::numeric_limits<double>::infinity()}), InvalidArgument);
  EXPECT_THROW(simulate_street_corner({.sensor = {.num_beams = 0}}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
