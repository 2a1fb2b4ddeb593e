// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/simulated_scans.h"

#include "trysquare/core/error.h"
#include "trysquare/parallel/for_each_block.h"
#include "trysquare/simulation/drive.h"
#include "trysquare/simulation/internal/mesh_builder.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trysquare {
namespace {

const Eigen::Vector3d kLow(-4, -5, -1);
const Eigen::Vector3d kHigh(6, 3, 2);

/// A closed room.
SimulatedWorld room() {
  internal::MeshBuilder mesh;
  const Eigen::Vector2d center = (kLow + kHigh).head<2>() / 2;
  mesh.add_block(internal::rectangle(center, 10, 8, 0), kLow.z(), kHigh.z());
  mesh.add_quad(kLow, {6, -5, -1}, {6, 3, -1}, {-4, 3, -1});
  return {.mesh = mesh.take()};
}

/// From inside the room to its walls: slabs.
double range_in_room(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Eigen::Array3d a = (kLow - origin).array() / direction.array();
  const Eigen::Array3d b = (kHigh - origin).array() / direction.array();
  return a.max(b).minCoeff();
}

constexpr SensorModel kSmall{
    .num_beams = 8, .num_azimuths = 90, .lowest_elevation_rad = -0.4, .highest_elevation_rad = 0.3, .range_sigma_m = 0};

SensorModel noisy(double sigma_m, double dropout = 0) {
  SensorModel sensor{.num_beams = 32, .num_azimuths = 720};
  sensor.range_sigma_m = sigma_m;
  sensor.dropout = dropout;
  return sensor;
}

Trajectory poses(std::size_t n) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < n; ++i) {
    const double at = static_cast<double>(i);
    trajectory.world_from_scan.push_back(
        {Eigen::AngleAxisd(0.2 * at, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(), {0.3 * at, 0, 0.1}});
  }
  return trajectory;
}

TEST(SimulatedScans, WithoutNoiseEveryPointLiesOnASurfaceBeamByBeam) {
  const SimulatedScans scans(room(), poses(4), kSmall, 1);
  const auto directions = ray_directions_in_scan(kSmall);
  for (std::size_t i = 0; i < 4; ++i) {
    const Pose pose = poses(4).world_from_scan[i];
    const Scan scan = scans.load(i);
    ASSERT_EQ(scan.points_in_scan.size(), directions.size());
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const double expected_m = range_in_room(pose.translation, pose.rotation * directions[k]);
      ASSERT_LT((scan.points_in_scan[k] - expected_m * directions[k]).norm(), 1e-9);
    }
  }
}

TEST(SimulatedScans, NoiseLiesAlongTheRayAndHasTheRequestedSize) {
  const auto truth = SimulatedScans(room(), poses(1), noisy(0), 3).load(0).points_in_scan;
  const auto measured = SimulatedScans(room(), poses(1), noisy(0.02), 3).load(0).points_in_scan;
  ASSERT_EQ(truth.size(), measured.size());
  double sum = 0;
  double sum_of_squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    ASSERT_LT(truth[i].normalized().cross(measured[i]).norm(), 1e-13);
    const double error_m = measured[i].norm() - truth[i].norm();
    sum += error_m;
    sum_of_squares += error_m * error_m;
  }
  const auto n = static_cast<double>(truth.size());
  EXPECT_NEAR(sum / n, 0, 5 * 0.02 / std::sqrt(n));
  EXPECT_NEAR(sum_of_squares / n / (0.02 * 0.02), 1, 5 * std::sqrt(2 / n));
}

TEST(SimulatedScans, DropoutLosesItsShareAndMovesNoOtherPoint) {
  const auto all = SimulatedScans(room(), poses(1), noisy(0.02), 3).load(0).points_in_scan;
  const auto some = SimulatedScans(room(), poses(1), noisy(0.02, 0.3), 3).load(0).points_in_scan;
  const auto n = static_cast<double>(all.size());
  EXPECT_NEAR(static_cast<double>(some.size()) / n, 0.7, 5 * std::sqrt(0.3 * 0.7 / n));
  std::size_t at = 0;
  for (const Eigen::Vector3d& point : some) {
    while (at < all.size() && all[at] != point) ++at;
    ASSERT_LT(at, all.size());
  }
  EXPECT_TRUE(SimulatedScans(room(), poses(1), noisy(0.02, 1), 3).load(0).points_in_scan.empty());
}

TEST(SimulatedScans, LosesReturnsOutOfRange) {
  SensorModel sensor = noisy(0.02);
  sensor.min_range_m = 3.5;
  sensor.max_range_m = 5;
  const auto points = SimulatedScans(room(), poses(1), sensor, 3).load(0).points_in_scan;
  EXPECT_GT(points.size(), 1000U);
  for (const Eigen::Vector3d& point : points) {
    ASSERT_GT(point.norm(), 3.5);
    ASSERT_LT(point.norm(), 5);
  }
}

TEST(SimulatedScans, ARollingShutterFiresEveryColumnFromWhereTheSensorIsByThen) {
  const Eigen::Vector3d velocity(8, 1, 0);
  constexpr double kTurn = 0.9;  // [rad/s]
  Trajectory trajectory;
  for (const double time_s : {0.0, 0.2}) {  // a period is half of the way
    trajectory.world_from_scan.push_back(
        {Eigen::AngleAxisd(0.3 + kTurn * time_s, Eigen::Vector3d::UnitZ()).toRotationMatrix(), velocity * time_s});
    trajectory.stamps_ns.push_back(std::llround(time_s * 1e9));
  }
  SensorModel sensor = kSmall;
  sensor.rolling_shutter = true;
  const SimulatedScans scans(room(), trajectory, sensor, 1);
  const auto directions = ray_directions_in_scan(sensor);
  for (const std::size_t index : {0U, 1U}) {  // after the last pose the motion goes on
    const Scan scan = scans.load(index);
    ASSERT_EQ(scan.points_in_scan.size(), directions.size());
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const double time_s = 0.2 * static_cast<double>(index) + 0.1 * static_cast<double>(k % 90) / 90;
      const Eigen::Matrix3d rotation =
          Eigen::AngleAxisd(0.3 + kTurn * time_s, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      const double expected_m = range_in_room(velocity * time_s, rotation * directions[k]);
      ASSERT_LT((scan.points_in_scan[k] - expected_m * directions[k]).norm(), 1e-9) << index << " " << k;
    }
  }
}

TEST(SimulatedScans, WithoutARollingShutterTheMotionDoesNotMatter) {
  Trajectory moved = poses(2);
  moved.world_from_scan[1].translation.x() += 1;
  EXPECT_EQ(SimulatedScans(room(), moved, kSmall, 1).load(0).points_in_scan,
            SimulatedScans(room(), poses(2), kSmall, 1).load(0).points_in_scan);
}

TEST(SimulatedScans, AMovingThingIsSeenWhereItIsByThen) {
  SimulatedWorld world = room();
  internal::MeshBuilder cube;
  cube.add_block(internal::rectangle({0, 0}, 1, 1, 0), -0.5, 0.5);
  world.moving.push_back({.mesh_in_object = cube.take(), .path_in_world = {{3, -2, 0}, {3, 3, 0}}, .speed_mps = 2});
  Trajectory still{std::vector<Pose>(2), {0, 1'000'000'000}};
  SensorModel ahead{.num_beams = 1, .num_azimuths = 1, .lowest_elevation_rad = 0, .highest_elevation_rad = 0};
  ahead.range_sigma_m = 0;
  ahead.horizontal_fov_rad = 0.1;
  const SimulatedScans scans(world, still, ahead, 1);
  EXPECT_LT((scans.load(0).points_in_scan.at(0) - Eigen::Vector3d(6, 0, 0)).norm(), 1e-9);    // 2 m beside the ray
  EXPECT_LT((scans.load(1).points_in_scan.at(0) - Eigen::Vector3d(2.5, 0, 0)).norm(), 1e-9);  // in front of the wall
}

TEST(SimulatedScans, AreTheSameBytesAtEveryThreadCount) {
  const auto all_points = [](int num_threads) {
    const SimulatedWorld world = make_world(WorldStyle::kStreet, 4, {.num_moving_cars = 3});
    SensorModel sensor = noisy(0.02, 0.1);
    sensor.rolling_shutter = true;
    const SimulatedScans scans(world, drive(world, {.num_scans = 12, .seed = 4}), sensor, 4);
    std::vector<std::vector<Eigen::Vector3d>> points(scans.size());
    for_each_block(scans.size(), 1, {.num_threads = num_threads}, "scans",
                   [&](const Block& block) { points[block.index] = scans.load(block.index).points_in_scan; });
    return points;
  };
  const auto one = all_points(1);
  EXPECT_GT(one[0].size(), 10'000U);
  EXPECT_NE(one[0], one[1]);
  EXPECT_EQ(all_points(2), one);
  EXPECT_EQ(all_points(5), one);
}

TEST(SimulatedScans, DrawOtherNoiseForEveryScanAndSeed) {
  const Trajectory still{std::vector<Pose>(2), {}};
  const SimulatedScans scans(room(), still, noisy(0.02), 1);
  EXPECT_NE(scans.load(0).points_in_scan, scans.load(1).points_in_scan);
  EXPECT_EQ(scans.load(1).points_in_scan, scans.load(1).points_in_scan);
  EXPECT_NE(SimulatedScans(room(), still, noisy(0.02), 2).load(0).points_in_scan, scans.load(0).points_in_scan);
}

TEST(SimulatedScans, CarryTimeStampsAndNames) {
  Trajectory trajectory = poses(2);
  EXPECT_FALSE(SimulatedScans(room(), trajectory, kSmall, 1).load(1).stamp_ns.has_value());
  trajectory.stamps_ns = {5, 7};
  const SimulatedScans scans(room(), trajectory, kSmall, 1);
  EXPECT_EQ(scans.load(1).stamp_ns, 7);
  EXPECT_EQ(scans.size(), 2U);
  EXPECT_EQ(scans.name(1), "scan 1");
  EXPECT_EQ(scans.true_poses().stamps_ns, trajectory.stamps_ns);
}

TEST(SimulatedScans, RefuseWhatTheyCannotSimulate) {
  EXPECT_THROW(SimulatedScans(room(), poses(2), kSmall, 1).load(2), InvalidArgument);
  Trajectory trajectory = poses(2);
  trajectory.stamps_ns = {1};
  EXPECT_THROW(SimulatedScans(room(), trajectory, kSmall, 1), InvalidArgument);
  trajectory.stamps_ns = {1, 1};
  EXPECT_THROW(SimulatedScans(room(), trajectory, kSmall, 1), InvalidArgument);
  trajectory = poses(2);
  trajectory.world_from_scan[1].translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SimulatedScans(room(), trajectory, kSmall, 1), InvalidArgument);
  SensorModel broken = kSmall;
  broken.dropout = 2;
  EXPECT_THROW(SimulatedScans(room(), poses(2), broken, 1), InvalidArgument);
  SimulatedWorld world = room();
  world.moving.push_back({.mesh_in_object = room().mesh, .path_in_world = {{0, 0, 0}}});
  EXPECT_THROW(SimulatedScans(world, poses(2), kSmall, 1), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
