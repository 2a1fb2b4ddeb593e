// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/mom.h"

#include "trysquare/metrics/metrics_test_scenes.h"
#include "trysquare/metrics/mpv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace trysquare {
namespace {

const NeighborhoodSettings kNeighborhood{.radius_m = 1.0, .min_neighbors = 4};

OrthogonalMetricResult mom_of(const test::Scene& scene, double radius_m = 1.0,
                              Definition definition = Definition::kPaper) {
  return mom(orthogonal_statistics(PointIndex(scene.map), scene.subset, {.radius_m = radius_m, .min_neighbors = 4}),
             definition);
}

TEST(Mom, IsTheAverageOfTheMpvsOfItsDirections) {
  const test::Scene scene = test::three_walls(0.02);
  const PointIndex index(scene.map);
  double sum = 0;
  for (const OrthogonalSubset::Direction& direction : scene.subset.directions) {
    sum += *mpv(point_statistics(index, direction.points_in_map, kNeighborhood)).value;
  }
  EXPECT_DOUBLE_EQ(*mom_of(scene).value, sum / 3);
}

TEST(Mom, OfMapMetricsIsTheSumOfTheMedians) {
  const OrthogonalMetricResult result = mom_of(test::three_walls(0.02), 1.0, Definition::kMapMetrics);
  double sum = 0;
  for (const OrthogonalMetricResult::Direction& direction : result.directions) sum += *direction.median;
  EXPECT_DOUBLE_EQ(*result.value, sum);
  EXPECT_DOUBLE_EQ(*result.sum_of_medians, sum);
  EXPECT_NE(*result.value, *result.mean_of_means);
}

TEST(Mom, GivesMeanAndMedianOfEachDirection) {
  OrthogonalStatistics statistics;
  statistics.directions.resize(1);
  statistics.directions[0].points.plane_variances = {1.0, 2.0, 6.0};
  const OrthogonalMetricResult result = mom(statistics);
  EXPECT_DOUBLE_EQ(*result.directions[0].mean, 3.0);
  EXPECT_DOUBLE_EQ(*result.directions[0].median, 2.0);
}

TEST(Mom, FollowsTrajectoryErrorWithThreeDirectionsOnly) {
  test::Scene scene = test::three_walls(0.02);
  EXPECT_TRUE(mom_of(scene).follows_trajectory_error);
  scene.subset.directions.pop_back();
  EXPECT_FALSE(mom_of(scene).follows_trajectory_error);
  EXPECT_TRUE(mom_of(scene).value);
}

TEST(Mom, OfScansThatStreamByIsThatOfTheMap) {
  const test::Scene scene = test::three_walls(0.02);
  const PointsOfScan points_of_scan = [&](std::size_t scan) {
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < scene.map.points_in_map.size(); ++i) {
      if (scene.map.scan_of_point[i] == scan) points.push_back(scene.map.points_in_map[i]);
    }
    return points;
  };
  const OrthogonalStatistics statistics =
      orthogonal_statistics(scene.map.num_scans, points_of_scan, scene.subset, kNeighborhood);
  const OrthogonalMetricResult streamed = mom(statistics);
  const OrthogonalMetricResult whole = mom_of(scene);
  EXPECT_NEAR(*streamed.value / *whole.value, 1.0, 1e-12);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(streamed.directions[i].num_used, whole.directions[i].num_used);
    EXPECT_NEAR(*streamed.directions[i].median / *whole.directions[i].median, 1.0, 1e-11);
    EXPECT_EQ(statistics.directions[i].points.size(), scene.subset.directions[i].points_in_map.size());
  }
}

TEST(Mom, IsUndefinedWithoutDirections) {
  test::Scene scene = test::three_walls(0.02);
  scene.subset.directions.clear();
  EXPECT_FALSE(mom_of(scene).value);
  EXPECT_EQ(mom_of(scene).reason, "there are no orthogonal directions");
}

// map-metrics returns 0.0 here: the emptiest map would win.
TEST(Mom, IsUndefinedWhereNoPointHasNeighbors) {
  test::Scene scene = test::three_walls(0.02);
  scene.map.points_in_map.resize(2);
  scene.map.scan_of_point.resize(2);
  const OrthogonalMetricResult result = mom_of(scene);
  EXPECT_FALSE(result.value);
  EXPECT_FALSE(result.sum_of_medians);
  EXPECT_EQ(result.directions[0].num_too_few, result.directions[0].num_points);
}

TEST(Mom, AveragesTheDefinedDirectionsAndSaysThatOneIsMissing) {
  test::Scene scene = test::three_walls(0.02);
  for (Eigen::Vector3d& point : scene.subset.directions[1].points_in_map) point.x() += 1000;
  const OrthogonalMetricResult result = mom_of(scene);
  EXPECT_DOUBLE_EQ(*result.value, (*result.directions[0].mean + *result.directions[2].mean) / 2);
  EXPECT_FALSE(result.directions[1].mean);
  EXPECT_FALSE(result.follows_trajectory_error);
}

TEST(MomProperty, InvariantUnderRigidMotion) {
  const test::Scene scene = test::three_walls(0.02);
  const test::Scene moved = test::transformed(scene, test::some_rotation(), {100, -50, 20});
  EXPECT_NEAR(*mom_of(moved).value / *mom_of(scene).value, 1.0, 1e-10);
}

TEST(MomProperty, InvariantUnderTheOrderOfThePoints) {
  test::Scene scene = test::three_walls(0.02);
  const double before = *mom_of(scene).value;
  std::shuffle(scene.map.points_in_map.begin(), scene.map.points_in_map.end(), std::mt19937(5));
  EXPECT_NEAR(*mom_of(scene).value / before, 1.0, 1e-12);
}

TEST(MomProperty, ScalesWithLengthSquared) {
  const test::Scene scene = test::three_walls(0.02);
  const test::Scene larger = test::transformed(scene, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 4.0);
  EXPECT_NEAR(*mom_of(larger, 4.0).value / *mom_of(scene).value, 16.0, 1e-9);
}

// ---- The lemmas of the paper's §IV: walls that every scan sees with the same points, shifted by its pose error. ----

/// Offsets of N poses, up to a few centimetres.
std::vector<Eigen::Vector3d> pose_errors(std::size_t num_poses) {
  std::mt19937_64 rng(11);
  std::uniform_real_distribution<double> offset_m(-0.03, 0.03);
  std::vector<Eigen::Vector3d> errors;
  for (std::size_t i = 0; i < num_poses; ++i) errors.emplace_back(offset_m(rng), offset_m(rng), offset_m(rng));
  return errors;
}

/// A 0.3 m grid of 5 × 5 points on each of three walls far from each other; the subset is the middle of each. All 25
/// lie within 1 m of the middle, with or without the errors.
test::Scene three_grids(const std::vector<Eigen::Vector3d>& errors) {
  test::Scene scene;
  scene.map.num_scans = errors.size();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d middle = 10.0 * Eigen::Vector3d::Unit(axis);
    scene.subset.directions.push_back({Eigen::Vector3d::Unit(axis), {middle}});
    for (std::size_t i = 0; i < errors.size(); ++i) {
      for (int k = 0; k < 25; ++k) {
        Eigen::Vector3d point = middle + errors[i];
        point[(axis + 1) % 3] += 0.3 * (k % 5 - 2);
        point[(axis + 2) % 3] += 0.3 * (k / 5 - 2);  // NOLINT(bugprone-integer-division): rows of the grid
        scene.map.points_in_map.push_back(point);
        scene.map.scan_of_point.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }
  return scene;
}

double sum_over_ordered_pairs(const std::vector<Eigen::Vector3d>& errors, Eigen::Index axis) {
  double sum = 0;
  for (const Eigen::Vector3d& a : errors) {
    for (const Eigen::Vector3d& b : errors) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  }
  return sum;
}

class Lemmas : public testing::TestWithParam<std::size_t> {};

// Lemma 1 with errors along the normal only: v = α · RPE with RPE = 1/N Σ over ordered pairs. The paper's α =
// 1/(2(N−1)) holds for one point a scan; with k points a scan it is k/(2(Nk − 1)), which tends to 1/(2N).
TEST_P(Lemmas, OneRelatesTheVarianceOfOneWallToRpe) {
  std::vector<Eigen::Vector3d> errors = pose_errors(GetParam());
  for (Eigen::Vector3d& error : errors) error.tail<2>().setZero();
  const double n = static_cast<double>(errors.size());
  const double paper_rpe = sum_over_ordered_pairs(errors, 0) / n;
  const OrthogonalMetricResult result = mom_of(three_grids(errors));
  EXPECT_NEAR(*result.directions[0].mean / (25 / (2 * (n * 25 - 1)) * paper_rpe), 1.0, 1e-9);
}

// Lemma 2: the sum over three directions is RPE² up to a factor that knows the number of poses only, whatever the
// direction of the errors; the mean over directions, and any single direction, is not.
TEST_P(Lemmas, TwoRelatesTheSumOverDirectionsToRpe) {
  const std::vector<Eigen::Vector3d> errors = pose_errors(GetParam());
  const double n = static_cast<double>(errors.size());
  double rpe_squared = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) rpe_squared += sum_over_ordered_pairs(errors, axis) / (n * (n - 1));
  const OrthogonalMetricResult result = mom_of(three_grids(errors));
  const double sum_of_means = 3 * *result.value;
  const double predicted = 2 * n / (n - 1) * sum_of_means * (25 * n - 1) / (25 * n);
  // Errors within the wall shear the pooled grid by at most 0.03 m in 0.6 m and move λ₁ at second order.
  EXPECT_NEAR(predicted / rpe_squared, 1.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Poses, Lemmas, testing::Values(2, 5, 15, 30));

}  // namespace
}  // namespace trysquare
