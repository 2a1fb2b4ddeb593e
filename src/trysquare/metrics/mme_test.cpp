// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/mme.h"

#include "trysquare/metrics/metrics_test_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace trysquare {
namespace {

MetricResult mme_of(const std::vector<Eigen::Vector3d>& points, double radius_m = 1.0,
                    Definition definition = Definition::kPaper) {
  return mme(point_statistics(PointIndex(points), points, {.radius_m = radius_m}, definition), definition);
}

TEST(Mme, IsTheMeanOverUsedPoints) {
  PointStatistics statistics;
  statistics.plane_variances = {1, 1, 1, 1};
  statistics.entropies = {-3.0, std::nan(""), -1.0, std::nan("")};
  statistics.entropy_support = {.num_defined = 2, .num_degenerate = 1, .num_too_few = 1};
  EXPECT_DOUBLE_EQ(*mme(statistics).value, -2.0);
  EXPECT_EQ(mme(statistics).num_used, 2u);
  EXPECT_DOUBLE_EQ(*mme(statistics, Definition::kAisBonn).value, -1.0);  // the undefined two count as 0
}

// Eight corners of a cube of edge a: Σ = (a²/4)(8/7) I, so h = 1.5 ln(2πe · 2a²/7).
TEST(Mme, OfACubesCornersIsTheClosedForm) {
  const double a = 0.3;
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(a * (i & 1), a * ((i >> 1) & 1), a * ((i >> 2) & 1));
  EXPECT_NEAR(*mme_of(corners).value, 1.5 * std::log(2 * std::numbers::pi * std::numbers::e * 2 * a * a / 7), 1e-13);
}

TEST(Mme, OfExactPlanesIsUndefinedAndSaysWhy) {
  const MetricResult result = mme_of(test::three_walls(0.0).map.points_in_map);
  EXPECT_FALSE(result.value);
  EXPECT_EQ(result.num_degenerate, result.num_queries);
  EXPECT_THAT(result.reason, testing::HasSubstr("lie exactly in a plane"));
}

TEST(Mme, OfNothingIsUndefined) { EXPECT_FALSE(mme_of({}).value); }

TEST(Mme, LeavesDegeneratePointsOutOfTheMean) {
  std::vector<Eigen::Vector3d> points = test::three_walls(0.02).map.points_in_map;
  const double before = *mme_of(points).value;
  const std::vector<Eigen::Vector3d> flat = test::three_walls(0.0).map.points_in_map;
  for (const Eigen::Vector3d& point : flat) points.push_back(point + Eigen::Vector3d(100, 0, 0));
  const MetricResult both = mme_of(points);
  EXPECT_NEAR(*both.value, before, 1e-11);
  EXPECT_EQ(both.num_degenerate, flat.size());
}

TEST(MmeProperty, InvariantUnderRigidMotion) {
  const test::Scene scene = test::three_walls(0.02);
  const test::Scene moved = test::transformed(scene, test::some_rotation(), {100, -50, 20});
  EXPECT_NEAR(*mme_of(moved.map.points_in_map).value, *mme_of(scene.map.points_in_map).value, 1e-10);
}

TEST(MmeProperty, GrowsByThreeLogarithmsOfTheScale) {
  const test::Scene scene = test::three_walls(0.02);
  const test::Scene larger = test::transformed(scene, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 4.0);
  EXPECT_NEAR(*mme_of(larger.map.points_in_map, 4.0).value - *mme_of(scene.map.points_in_map).value, 3 * std::log(4),
              1e-10);
}

// MapEval leaves out the cube of 2πe; where all neighborhoods are large, leaving out the query hardly matters.
TEST(MmeProperty, OfMapEvalIsLowerByTheLogarithmOfTwoPiE) {
  const std::vector<Eigen::Vector3d> points = test::three_walls(0.02, 3000).map.points_in_map;
  const double difference = *mme_of(points).value - *mme_of(points, 1.0, Definition::kMapEval).value;
  EXPECT_NEAR(difference, std::log(2 * std::numbers::pi * std::numbers::e), 0.02);
}

}  // namespace
}  // namespace trysquare
