// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/point_statistics.h"

#include "trysquare/metrics/metrics_test_scenes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace trysquare {
namespace {

// Written out from the definitions, point by point; shares nothing with the code under test but Eigen.
struct Expected {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::size_t count = 0;
};

Expected brute_force(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& query, double radius,
                     double divisor_offset = 1, bool leave_out_query = false) {
  std::vector<Eigen::Vector3d> inside;
  for (const Eigen::Vector3d& point : points) {
    if ((point - query).squaredNorm() < radius * radius && !(leave_out_query && point == query))
      inside.push_back(point);
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : inside) mean += point / static_cast<double>(inside.size());
  Expected expected{.count = inside.size()};
  for (const Eigen::Vector3d& point : inside) expected.covariance += (point - mean) * (point - mean).transpose();
  expected.covariance /= static_cast<double>(inside.size()) - divisor_offset;
  return expected;
}

const double kTwoPiE = 2 * std::numbers::pi * std::numbers::e;

class PointStatisticsOfAScene : public testing::Test {
 protected:
  test::Scene scene = test::three_walls(0.02, 150, 3);
  std::vector<Eigen::Vector3d>& points = scene.map.points_in_map;
  PointIndex index{scene.map};
};

TEST_F(PointStatisticsOfAScene, AreThoseOfBruteForce) {
  const PointStatistics statistics = point_statistics(index, points, {.radius_m = 0.7});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Expected expected = brute_force(points, points[i], 0.7);
    ASSERT_EQ(statistics.num_neighbors[i], expected.count);
    ASSERT_EQ(std::isnan(statistics.entropies[i]), expected.count < 6);
    if (expected.count < 6) continue;
    const double lambda = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(expected.covariance).eigenvalues()[0];
    ASSERT_NEAR(statistics.plane_variances[i] / lambda, 1, 1e-9);
    ASSERT_NEAR(statistics.entropies[i], 0.5 * std::log((kTwoPiE * expected.covariance).determinant()), 1e-9);
  }
}

TEST_F(PointStatisticsOfAScene, FollowMapEvalWhenAskedTo) {
  const PointStatistics statistics = point_statistics(index, points, {.radius_m = 0.5}, Definition::kMapEval);
  std::size_t num_too_few = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Expected others = brute_force(points, points[i], 0.5, 1, true);
    ASSERT_EQ(std::isnan(statistics.entropies[i]), others.count < 10);
    if (others.count < 10) {
      ++num_too_few;
    } else {
      ASSERT_NEAR(statistics.entropies[i], 0.5 * std::log(kTwoPiE * others.covariance.determinant()), 1e-9);
    }
  }
  EXPECT_GT(num_too_few, 0u);
  EXPECT_LT(num_too_few, points.size());
  EXPECT_EQ(statistics.entropy_support.num_too_few, num_too_few);
}

TEST_F(PointStatisticsOfAScene, FollowAisBonnWhenAskedTo) {
  const PointStatistics statistics = point_statistics(index, points, {.radius_m = 0.25}, Definition::kAisBonn);
  std::size_t num_below_six = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Expected expected = brute_force(points, points[i], 0.25, 0);
    ASSERT_EQ(std::isnan(statistics.entropies[i]), expected.count < 4) << expected.count;
    if (expected.count < 4) continue;
    if (expected.count < 6) ++num_below_six;
    ASSERT_NEAR(statistics.entropies[i], 0.5 * std::log((kTwoPiE * expected.covariance).determinant()), 1e-7);
  }
  EXPECT_GT(num_below_six, 0u);
}

TEST(PointStatistics, LeavePointsWithTooFewNeighborsUndefined) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}, {0.1, 0.1, 0}};
  const PointStatistics five = point_statistics(PointIndex(points), points, {.radius_m = 1, .min_neighbors = 6});
  EXPECT_EQ(five.plane_variance_support.num_too_few, 5u);
  EXPECT_TRUE(std::isnan(five.plane_variances[0]));
  EXPECT_TRUE(std::isnan(five.entropies[0]));
  const PointStatistics enough = point_statistics(PointIndex(points), points, {.radius_m = 1, .min_neighbors = 5});
  EXPECT_EQ(enough.plane_variance_support.num_defined, 5u);
}

// Rotated, so that rounding gives determinants of ±1e-20 instead of exact zeros.
TEST(PointStatistics, CountExactlyPlanarNeighborhoodsAsDegenerate) {
  test::Scene scene = test::transformed(test::three_walls(0.0, 400, 1), test::some_rotation(), {3, 4, 5});
  const PointStatistics statistics =
      point_statistics(PointIndex(scene.map), scene.map.points_in_map, {.radius_m = 1.0});
  EXPECT_EQ(statistics.plane_variance_support.num_degenerate, statistics.size());
  EXPECT_EQ(statistics.entropy_support.num_degenerate, statistics.size());
  for (std::size_t i = 0; i < statistics.size(); ++i) {
    ASSERT_EQ(statistics.plane_variances[i], 0.0);
    ASSERT_TRUE(std::isnan(statistics.entropies[i]));
  }
}

TEST(PointStatistics, CountCopiesOfThreePointsAsDegenerate) {
  std::vector<Eigen::Vector3d> points;
  for (int copy = 0; copy < 10; ++copy)
    points.insert(points.end(), {{0.1, 0.2, 0.3}, {0.4, 0.1, 0.5}, {0.2, 0.6, 0.1}});
  const PointStatistics statistics = point_statistics(PointIndex(points), points, {.radius_m = 2});
  EXPECT_EQ(statistics.num_neighbors[0], 30u);
  EXPECT_EQ(statistics.plane_variance_support.num_degenerate, 30u);
}

TEST(PointStatistics, CountLineLikeNeighborhoods) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 20; ++i) points.emplace_back(0.1 * i, 0.001 * (i % 3), 0.001 * (i % 2));
  const PointStatistics statistics = point_statistics(PointIndex(points), points, {.radius_m = 10});
  EXPECT_EQ(statistics.num_line_like, 20u);
}

}  // namespace
}  // namespace trysquare
