// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/mpv.h"

#include "trysquare/metrics/metrics_test_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace trysquare {
namespace {

MetricResult mpv_of(const std::vector<Eigen::Vector3d>& points, double radius_m = 1.0) {
  return mpv(point_statistics(PointIndex(points), points, {.radius_m = radius_m}));
}

TEST(Mpv, IsTheMeanOverUsedPoints) {
  PointStatistics statistics;
  statistics.plane_variances = {1.0, std::nan(""), 0.0, 5.0};
  statistics.plane_variance_support = {.num_defined = 2, .num_degenerate = 1, .num_too_few = 1};
  const MetricResult result = mpv(statistics);
  EXPECT_DOUBLE_EQ(*result.value, 2.0);
  EXPECT_EQ(result.num_queries, 4u);
  EXPECT_EQ(result.num_used, 3u);
  EXPECT_EQ(result.num_degenerate, 1u);
  EXPECT_EQ(result.num_too_few, 1u);
}

TEST(Mpv, OfNothingIsUndefinedAndSaysWhy) {
  const MetricResult result = mpv_of({});
  EXPECT_FALSE(result.value);
  EXPECT_EQ(result.reason, "there are no query points");
}

TEST(Mpv, OfTwoPointsIsUndefinedAndSaysWhy) {
  const MetricResult result = mpv_of({{0, 0, 0}, {0.1, 0, 0}});
  EXPECT_FALSE(result.value);
  EXPECT_THAT(result.reason, testing::HasSubstr("of 2, 2 have too few neighbors"));
}

TEST(Mpv, OfAnExactPlaneIsZeroAndCountsEveryPointAsDegenerate) {
  const MetricResult result = mpv_of(test::three_walls(0.0).map.points_in_map);
  EXPECT_EQ(*result.value, 0.0);
  EXPECT_EQ(result.num_degenerate, result.num_queries);
}

TEST(Mpv, OfNoisyWallsIsTheVarianceOfTheNoise) {
  const MetricResult result = mpv_of(test::three_walls(0.02, 3000).map.points_in_map);
  EXPECT_NEAR(*result.value / (0.02 * 0.02), 1.0, 0.05);
}

TEST(MpvProperty, InvariantUnderRigidMotion) {
  const test::Scene scene = test::three_walls(0.02);
  const test::Scene moved = test::transformed(scene, test::some_rotation(), {100, -50, 20});
  EXPECT_NEAR(*mpv_of(moved.map.points_in_map).value / *mpv_of(scene.map.points_in_map).value, 1.0, 1e-10);
}

TEST(MpvProperty, InvariantUnderTheOrderOfThePoints) {
  std::vector<Eigen::Vector3d> points = test::three_walls(0.02).map.points_in_map;
  const double before = *mpv_of(points).value;
  std::shuffle(points.begin(), points.end(), std::mt19937(5));
  EXPECT_NEAR(*mpv_of(points).value / before, 1.0, 1e-12);
}

TEST(MpvProperty, ScalesWithLengthSquared) {
  const test::Scene scene = test::three_walls(0.02);
  const test::Scene larger = test::transformed(scene, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 4.0);
  EXPECT_NEAR(*mpv_of(larger.map.points_in_map, 4.0).value / *mpv_of(scene.map.points_in_map).value, 16.0, 1e-9);
}

// 1 mm of noise at UTM coordinates: raw moments about the origin would be wrong by a factor of hundreds.
TEST(MpvProperty, SurvivesUtmCoordinates) {
  const test::Scene scene = test::three_walls(1e-3);
  const test::Scene utm = test::transformed(scene, Eigen::Matrix3d::Identity(), {5e5, 5e6, 100});
  EXPECT_NEAR(*mpv_of(utm.map.points_in_map).value / *mpv_of(scene.map.points_in_map).value, 1.0, 1e-5);
}

TEST(MpvProperty, GrowsWithTheNoise) {
  double last = 0;
  for (const double sigma_m : {0.005, 0.01, 0.02, 0.04}) {
    const double value = *mpv_of(test::three_walls(sigma_m).map.points_in_map).value;
    EXPECT_GT(value, last);
    last = value;
  }
}

}  // namespace
}  // namespace trysquare
