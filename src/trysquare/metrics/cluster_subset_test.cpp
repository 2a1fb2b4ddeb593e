// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/cluster_subset.h"

#include "trysquare/core/error.h"
#include "trysquare/metrics/metrics_test_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace trysquare {
namespace {

/// Largest |cosine| of `axis` with a found direction.
double best_match(const OrthogonalSubset& subset, const Eigen::Vector3d& axis) {
  double best = 0;
  for (const OrthogonalSubset::Direction& direction : subset.directions) {
    best = std::max(best, std::abs(direction.normal_in_map.dot(axis)));
  }
  return best;
}

TEST(ClusterSubset, FindsTheThreeWallsOfAScene) {
  const Eigen::Matrix3d rotation = test::some_rotation();
  const test::Scene scene = test::transformed(test::three_walls(0.01, 800), rotation, {5, 6, 7});
  const ClusterSubsetResult result = cluster_subset(scene.map, 0.7);
  ASSERT_EQ(result.subset.directions.size(), 3u);
  EXPECT_TRUE(result.reason.empty());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    EXPECT_GT(best_match(result.subset, rotation.col(axis)), std::cos(0.01)) << axis;
  }
}

TEST(ClusterSubset, PutsEveryPointOnTheWallOfItsDirection) {
  const test::Scene scene = test::three_walls(0.005, 800);
  const ClusterSubsetResult result = cluster_subset(scene.map, 0.7);
  ASSERT_EQ(result.subset.directions.size(), 3u);
  for (const OrthogonalSubset::Direction& direction : result.subset.directions) {
    EXPECT_GT(direction.points_in_map.size(), 200u);
    for (const Eigen::Vector3d& point : direction.points_in_map) {
      EXPECT_LT(std::abs(point.dot(direction.normal_in_map)), 0.2);
    }
  }
}

TEST(ClusterSubset, DoesNotDependOnTheOrderOfThePointsOfAScan) {
  test::Scene scene = test::three_walls(0.01, 800, 1);
  const ClusterSubsetResult before = cluster_subset(scene.map, 0.7);
  std::shuffle(scene.map.points_in_map.begin(), scene.map.points_in_map.end(), std::mt19937(9));
  const ClusterSubsetResult after = cluster_subset(scene.map, 0.7);
  ASSERT_EQ(before.subset.directions.size(), after.subset.directions.size());
  for (std::size_t i = 0; i < before.subset.directions.size(); ++i) {
    EXPECT_EQ(before.subset.directions[i].points_in_map, after.subset.directions[i].points_in_map);
  }
}

// A pose error of 0.5 m tears the walls apart; normals come from single scans and do not notice.
TEST(ClusterSubset, DoesNotLetPoseErrorsDecideWhatIsPlanar) {
  test::Scene scene = test::three_walls(0.01, 800, 2);
  for (std::size_t i = 0; i < scene.map.points_in_map.size(); ++i) {
    if (scene.map.scan_of_point[i] == 1) scene.map.points_in_map[i] += Eigen::Vector3d(0.3, 0.3, 0.3);
  }
  const ClusterSubsetResult result = cluster_subset(scene.map, 0.7);
  EXPECT_GT(static_cast<double>(result.num_planar), 0.8 * static_cast<double>(result.num_points));
}

TEST(ClusterSubset, JoinsColinearClustersUnlessToldNotTo) {
  test::Scene scene = test::three_walls(0.005, 800, 1);
  const std::size_t num_points = scene.map.points_in_map.size();
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.25, Eigen::Vector3d::UnitX()).toRotationMatrix();
  for (std::size_t i = 0; i < num_points;
       ++i) {  // a second floor, tilted by 14°: another cluster, but nearly co-linear
    if (std::abs(scene.map.points_in_map[i].z()) > 0.1) continue;
    scene.map.points_in_map.push_back(tilt * scene.map.points_in_map[i] + Eigen::Vector3d(0, 50, 0));
    scene.map.scan_of_point.push_back(0);
  }
  const auto num_subset_points = [&](bool join_colinear) {
    return cluster_subset(scene.map, 0.7, {.join_colinear = join_colinear}).subset.num_points();
  };
  EXPECT_GT(num_subset_points(true), num_subset_points(false) + 400);
}

TEST(ClusterSubset, OfOneWallIsOneDirectionAndSaysSo) {
  test::Scene scene = test::three_walls(0.01, 800, 1);
  std::erase_if(scene.map.points_in_map, [](const Eigen::Vector3d& point) { return std::abs(point.x()) > 1; });
  scene.map.scan_of_point.resize(scene.map.points_in_map.size());
  const ClusterSubsetResult result = cluster_subset(scene.map, 0.7);
  EXPECT_EQ(result.subset.directions.size(), 1u);
  EXPECT_THAT(result.reason, testing::HasSubstr("only 1 of 3"));
}

TEST(ClusterSubset, OfNoiseIsEmptyAndSaysWhy) {
  RegisteredMap map{.num_scans = 1};
  std::mt19937_64 rng(4);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  for (int i = 0; i < 500; ++i) map.points_in_map.emplace_back(anywhere(rng), anywhere(rng), anywhere(rng));
  map.scan_of_point.assign(500, 0);
  const ClusterSubsetResult result = cluster_subset(map, 0.7);
  EXPECT_TRUE(result.subset.directions.empty());
  EXPECT_THAT(result.reason, testing::HasSubstr("none of 500 points lies in a plane"));
}

// Across a line everything is rounding, and as flat as you please.
TEST(ClusterSubset, OfALineIsEmpty) {
  RegisteredMap map{.num_scans = 1};
  for (int i = 0; i < 500; ++i) map.points_in_map.push_back(0.01 * i * Eigen::Vector3d(1, std::sqrt(2), 1.7));
  map.scan_of_point.assign(500, 0);
  for (const ClusterSubsetSettings& settings : {ClusterSubsetSettings{}, map_metrics_subset_settings()}) {
    const ClusterSubsetResult result = cluster_subset(map, 0.5, settings);
    EXPECT_EQ(result.num_planar, 0u);
    EXPECT_TRUE(result.subset.directions.empty());
  }
}

TEST(ClusterSubset, GivesAClusterToTheNearestDirectionOnly) {
  test::Scene scene = test::three_walls(0.002, 800, 1);
  const std::size_t num_points = scene.map.points_in_map.size();
  // A floor tilted by 45° is co-linear with the floor and with a wall when |n·m| > 0.67 is enough.
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.785, Eigen::Vector3d::UnitX()).toRotationMatrix();
  for (std::size_t i = 0; i < num_points; ++i) {
    if (std::abs(scene.map.points_in_map[i].z()) > 0.1) continue;
    scene.map.points_in_map.push_back(tilt * scene.map.points_in_map[i] + Eigen::Vector3d(0, 50, 0));
    scene.map.scan_of_point.push_back(0);
  }
  const ClusterSubsetResult result = cluster_subset(scene.map, 0.7, {.orthogonality_bound = 0.33});
  EXPECT_LE(result.subset.num_points(), result.num_planar);
}

TEST(ClusterSubset, OfNothingIsEmpty) { EXPECT_TRUE(cluster_subset({}, 1.0).subset.directions.empty()); }

TEST(ClusterSubsetArguments, AreCheckedWithNameValueAndRange) {
  try {
    cluster_subset({}, 1.0, {.orthogonality_bound = 0.5});
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(), "orthogonal subset: orthogonality_bound = 0.5 is out of range: it must be in (0, 1/3)");
  }
  EXPECT_THROW(cluster_subset({}, 0.0), InvalidArgument);
  EXPECT_THROW(cluster_subset({}, 1.0, {.linkage_cut = 0}), InvalidArgument);
  EXPECT_THROW(cluster_subset({}, 1.0, {.num_scans = 0}), InvalidArgument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(cluster_subset({.points_in_map = {{0, nan, 0}}, .scan_of_point = {0}, .num_scans = 1}, 1.0),
               InvalidArgument);
  EXPECT_THROW(cluster_subset({.points_in_map = {{0, 0, 0}}, .scan_of_point = {0, 0}, .num_scans = 1}, 1.0),
               InvalidArgument);
}

}  // namespace
}  // namespace trysquare
