// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/patch_subset.h"

#include "trysquare/core/error.h"
#include "trysquare/synthetic/spinning_sensor.h"
#include "trysquare/synthetic/street_corner.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace trysquare {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// What a spinning LiDAR with 64 beams sees of a scene from three places, in the world frame turned by `turn`.
RegisteredMap seen_by_lidar(const std::vector<Rectangle>& scene,
                            const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity(), std::uint64_t seed = 1) {
  const SpinningSensor sensor{.num_beams = 64, .num_azimuths = 900};
  RegisteredMap map{.num_scans = 3};
  Random random(seed);
  for (std::uint32_t scan = 0; scan < 3; ++scan) {
    const Pose world_from_scan{Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.8 * scan, 0.1 * scan, 0)};
    for (const Eigen::Vector3d& point : cast_scan(scene, world_from_scan, sensor, random).points_in_scan) {
      map.points_in_map.push_back(turn * (world_from_scan * point));
      map.scan_of_point.push_back(scan);
    }
  }
  return map;
}

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) / kDegree;
}

/// Angle between an axis and the direction nearest to it.
double nearest_deg(const OrthogonalSubset& subset, const Eigen::Vector3d& axis) {
  double nearest = 90;
  for (const OrthogonalSubset::Direction& direction : subset.directions) {
    nearest = std::min(nearest, angle_deg(direction.normal_in_map, axis));
  }
  return nearest;
}

const std::vector<Rectangle> kFloor{{{-40, -40, -1.8}, {80, 0, 0}, {0, 80, 0}}};
const std::vector<Rectangle> kCorridor{{{-30, -2, -1.5}, {60, 0, 0}, {0, 4, 0}},
                                       {{-30, -2, 1.5}, {60, 0, 0}, {0, 4, 0}},
                                       {{-30, -2, -1.5}, {60, 0, 0}, {0, 0, 3}},
                                       {{-30, 2, -1.5}, {60, 0, 0}, {0, 0, 3}}};

TEST(PatchSubset, FindsTheAxesOfAStreetInAnyFrame) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  for (const Eigen::Matrix3d& map_from_world : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), turn}) {
    const PatchSubsetResult result = patch_subset(seen_by_lidar(street_corner_scene(), map_from_world), 1.0);
    ASSERT_EQ(result.subset.directions.size(), 3u);
    EXPECT_TRUE(result.reason.empty());
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      EXPECT_LT(nearest_deg(result.subset, map_from_world.col(axis)), 0.5);
    }
  }
}

TEST(PatchSubset, FindsTheAxesOfARoom) {
  const PatchSubsetResult result = patch_subset(seen_by_lidar(box({-3, -2, -1.2}, {6, 5, 2.5})), 0.4);
  ASSERT_EQ(result.subset.directions.size(), 3u);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    EXPECT_LT(nearest_deg(result.subset, Eigen::Matrix3d::Identity().col(axis)), 0.5);
  }
}

// Noise of 2 cm along the ray: no point is farther than 5 σ from its plane.
TEST(PatchSubset, PutsItsPointsOnSurfacesThatFaceTheAxis) {
  const std::vector<Rectangle> scene = street_corner_scene();
  const PatchSubsetResult result = patch_subset(seen_by_lidar(scene), 1.0);
  ASSERT_EQ(result.subset.directions.size(), 3u);
  for (const OrthogonalSubset::Direction& direction : result.subset.directions) {
    EXPECT_GT(direction.points_in_map.size(), 100u);
    for (const Eigen::Vector3d& point : direction.points_in_map) {
      const bool is_on_one = std::any_of(scene.begin(), scene.end(), [&](const Rectangle& rectangle) {
        const Eigen::Vector3d normal = rectangle.normal();
        return angle_deg(normal, direction.normal_in_map) < 1 && std::abs(normal.dot(point - rectangle.corner)) < 0.1;
      });
      EXPECT_TRUE(is_on_one);
    }
  }
}

/// How flat a scan is around a point, as far as `radius_m`: by brute force.
double flatness_around(const RegisteredMap& map, const Eigen::Vector3d& point, double radius_m) {
  std::uint32_t scan = 0;
  for (std::size_t i = 0; i < map.points_in_map.size(); ++i) {
    if (map.points_in_map[i] == point) scan = map.scan_of_point[i];
  }
  std::vector<Eigen::Vector3d> near;
  for (std::size_t i = 0; i < map.points_in_map.size(); ++i) {
    if (map.scan_of_point[i] == scan && (map.points_in_map[i] - point).norm() < radius_m)
      near.push_back(map.points_in_map[i]);
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : near) mean += p / static_cast<double>(near.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : near) covariance += (p - mean) * (p - mean).transpose();
  const Eigen::Vector3d lambda = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues();
  return lambda[0] / lambda[1];
}

// A patch near the edge of a wall is flat, what the metrics look at around it is not: MOM would measure the corner.
TEST(PatchSubset, TakesPointsThatAreFlatAsFarAsTheMetricsLook) {
  const RegisteredMap map = seen_by_lidar(street_corner_scene());
  for (const OrthogonalSubset::Direction& direction : patch_subset(map, 1.0).subset.directions) {
    ASSERT_GT(direction.points_in_map.size(), 12u);
    for (std::size_t i = 0; i < direction.points_in_map.size(); i += 40) {
      EXPECT_LT(100 * flatness_around(map, direction.points_in_map[i], 1.0), 1);
    }
  }
}

TEST(PatchSubset, KeepsTheFlattestPointsWhereNoneIsFlat) {
  const RegisteredMap map = seen_by_lidar(street_corner_scene());
  const PatchSubsetResult result = patch_subset(map, 1.0, {.planarity_ratio = 1e9, .min_points = 20});
  ASSERT_EQ(result.subset.directions.size(), 3u);
  for (const OrthogonalSubset::Direction& direction : result.subset.directions) {
    EXPECT_EQ(direction.points_in_map.size(), 20u);
    for (const Eigen::Vector3d& point : direction.points_in_map) EXPECT_LT(flatness_around(map, point, 1.0), 0.01);
  }
  EXPECT_THROW(patch_subset(map, 1.0, {.planarity_ratio = 0}), InvalidArgument);
  EXPECT_THROW(patch_subset(map, 1.0, {.min_points = 0}), InvalidArgument);
}

TEST(PatchSubset, CountsWhatItWasMadeFrom) {
  const PatchSubsetResult result = patch_subset(seen_by_lidar(street_corner_scene()), 1.0);
  EXPECT_GT(result.num_candidates, result.num_planar);
  EXPECT_GT(result.num_planar, result.num_patches);
  EXPECT_GE(result.num_modes, 3u);
  EXPECT_EQ(result.planar_share(), static_cast<double>(result.num_planar) / static_cast<double>(result.num_candidates));
  ASSERT_EQ(result.directions.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GE(result.directions[k].num_normals, result.subset.directions[k].points_in_map.size());
    EXPECT_EQ(result.directions[k].axis, result.subset.directions[k].normal_in_map);
  }
}

TEST(PatchSubset, OfAFloorIsOneDirectionAndSaysSo) {
  const PatchSubsetResult result = patch_subset(seen_by_lidar(kFloor), 1.0);
  ASSERT_EQ(result.subset.directions.size(), 1u);
  EXPECT_LT(nearest_deg(result.subset, Eigen::Vector3d::UnitZ()), 0.5);
  EXPECT_THAT(result.reason, testing::StartsWith("only 1 of 3 mutually orthogonal directions found in "));
}

TEST(PatchSubset, OfACorridorIsTwoDirections) {
  const PatchSubsetResult result = patch_subset(seen_by_lidar(kCorridor), 0.5);
  ASSERT_EQ(result.subset.directions.size(), 2u);
  EXPECT_LT(nearest_deg(result.subset, Eigen::Vector3d::UnitZ()), 0.5);
  EXPECT_LT(nearest_deg(result.subset, Eigen::Vector3d::UnitY()), 0.5);
}

// Random planes are at right angles, as well as anyone can tell, in one scene of fifty (one of the first 60 measured).
TEST(PatchSubset, OfRandomPlanesIsNoTriadMoreOftenThanPromised) {
  int num_triads = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed);
    std::vector<Rectangle> planes;
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d u = random.unit_direction();
      const Eigen::Vector3d v = u.cross(random.unit_direction()).normalized();
      planes.push_back({6 * random.unit_direction() - 2.5 * (u + v), 5 * u, 5 * v});
    }
    const RegisteredMap map = seen_by_lidar(planes, Eigen::Matrix3d::Identity(), seed);
    num_triads += patch_subset(map, 0.5).directions.size() == 3;
  }
  EXPECT_LE(num_triads, 1);
}

TEST(PatchSubset, OfFoliageIsEmptyAndSaysWhy) {
  RegisteredMap map{.num_scans = 1};
  Random random(2);
  for (int i = 0; i < 2000; ++i) map.points_in_map.push_back(random.normal_vector());
  map.scan_of_point.assign(2000, 0);
  const PatchSubsetResult result = patch_subset(map, 1.0);
  EXPECT_TRUE(result.subset.directions.empty());
  EXPECT_THAT(result.reason, testing::AllOf(testing::StartsWith("none of "), testing::HasSubstr("planar patch")));
}

TEST(PatchSubset, OfPlanesThatAreTooSmallSaysSo) {
  RegisteredMap map{.num_scans = 1};
  Random random(2);
  for (int i = 0; i < 100; ++i) map.points_in_map.emplace_back(0.3 * random.uniform(), 0.3 * random.uniform(), 0.0);
  map.scan_of_point.assign(100, 0);
  const PatchSubsetResult result = patch_subset(map, 1.0);
  EXPECT_TRUE(result.subset.directions.empty());
  EXPECT_THAT(result.reason, testing::StartsWith("no direction stands out among the normals of "));
}

TEST(PatchSubset, OfNothingIsEmpty) {
  const PatchSubsetResult result = patch_subset({}, 1.0);
  EXPECT_TRUE(result.subset.directions.empty());
  EXPECT_EQ(result.planar_share(), std::nullopt);
  EXPECT_EQ(result.reason, "none of 0 points lies on a planar patch");
}

TEST(PatchSubsetArguments, AreChecked) {
  EXPECT_THROW(patch_subset({}, 1.0, {.patches = {.spacing = 0}}), InvalidArgument);
  EXPECT_THROW(patch_subset({}, 1.0, {.triad = {.min_support = 0}}), InvalidArgument);
  EXPECT_THROW(patch_subset({}, -1.0), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
