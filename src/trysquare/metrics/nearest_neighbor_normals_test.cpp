// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/nearest_neighbor_normals.h"

#include "trysquare/core/error.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace trysquare {
namespace {

std::vector<Eigen::Vector3d> noisy_plane(std::size_t count) {
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> along(-2, 2);
  std::normal_distribution<double> across(0, 0.02);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = along(rng);
    const double y = along(rng);
    points.emplace_back(x, y, 0.3 * x - 0.2 * y + across(rng));
  }
  return points;
}

/// By sorting all points by their distance.
Eigen::Vector3d normal_by_sorting(std::vector<Eigen::Vector3d> points, const Eigen::Vector3d& query, double radius_m,
                                  std::size_t max_nearest) {
  std::erase_if(points, [&](const Eigen::Vector3d& p) { return (p - query).norm() >= radius_m; });
  std::sort(points.begin(), points.end(), [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (a - query).squaredNorm() < (b - query).squaredNorm();
  });
  points.resize(std::min(points.size(), max_nearest));
  Eigen::MatrixXd rows(points.size(), 3);
  for (std::size_t i = 0; i < points.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = points[i];
  const Eigen::MatrixXd centered = rows.rowwise() - rows.colwise().mean();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centered.transpose() * centered).eigenvectors().col(0);
}

TEST(NearestNeighborNormals, AreThoseOfTheNearestPointsWithinTheRadius) {
  const std::vector<Eigen::Vector3d> points = noisy_plane(600);
  for (const double radius_m : {0.3, 5.0}) {  // some 10 points are within 0.3 m
    const std::vector<Eigen::Vector3d> normals = nearest_neighbor_normals(points, points, radius_m, 20);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto num_near = std::count_if(points.begin(), points.end(),
                                          [&](const Eigen::Vector3d& p) { return (p - points[i]).norm() < radius_m; });
      ASSERT_EQ(normals[i].allFinite(), num_near >= 3) << i;
      if (num_near < 3) continue;
      ASSERT_NEAR(std::abs(normals[i].dot(normal_by_sorting(points, points[i], radius_m, 20))), 1, 1e-12) << i;
    }
  }
}

TEST(NearestNeighborNormals, HaveTheirLargestComponentPositive) {
  std::vector<Eigen::Vector3d> points = noisy_plane(200);
  for (const Eigen::Vector3d& normal : nearest_neighbor_normals(points, points, 1.0, 20)) EXPECT_GT(normal.z(), 0.5);
  for (Eigen::Vector3d& point : points) std::swap(point.x(), point.z());
  for (const Eigen::Vector3d& normal : nearest_neighbor_normals(points, points, 1.0, 20)) EXPECT_GT(normal.x(), 0.5);
}

TEST(NearestNeighborNormals, AreUndefinedWithFewerThanThreePoints) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {0.1, 0, 0}, {1, 0, 0}};
  EXPECT_TRUE(nearest_neighbor_normals(points, points, 1.0, 3)[0].hasNaN());  // the third is not nearer than 1 m
  EXPECT_FALSE(nearest_neighbor_normals(points, points, 1.1, 3)[0].hasNaN());
  EXPECT_TRUE(nearest_neighbor_normals({}, points, 1.0, 3)[0].hasNaN());
}

TEST(NearestNeighborNormals, RefusesWhatMakesNoSense) {
  EXPECT_THROW(nearest_neighbor_normals({}, {}, 0.0, 30), InvalidArgument);
  EXPECT_THROW(nearest_neighbor_normals({}, {}, 1.0, 2), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
