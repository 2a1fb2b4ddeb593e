// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/moments.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace trysquare {
namespace {

Moments moments_of(const std::vector<Eigen::Vector3d>& points) {
  MomentsAccumulator accumulator(points.front());
  for (const Eigen::Vector3d& point : points) accumulator.add(point);
  return accumulator.result();
}

double smallest_eigenvalue(const Moments& moments) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments.covariance).eigenvalues()[0];
}

// A 0.6 m square patch of a plane with Gaussian noise of the given σ along its (oblique) normal.
std::vector<Eigen::Vector3d> noisy_patch(double sigma_m, const Eigen::Vector3d& center_m) {
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> in_plane(-0.3, 0.3);
  std::normal_distribution<double> along_normal(0.0, sigma_m);
  const Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Eigen::Vector3d> points(200);
  std::generate(points.begin(), points.end(), [&]() -> Eigen::Vector3d {
    return center_m + axes * Eigen::Vector3d(in_plane(rng), in_plane(rng), along_normal(rng));
  });
  return points;
}

TEST(Moments, OfThreePointsByHand) {
  const Moments m = moments_of({{0, 0, 0}, {2, 0, 0}, {1, 3, 0}});
  EXPECT_EQ(m.count, 3u);
  EXPECT_EQ(m.mean_from_query, Eigen::Vector3d(1, 1, 0));
  EXPECT_DOUBLE_EQ(m.covariance(0, 0), 1.0);  // ((-1)² + 1² + 0²) / 2
  EXPECT_DOUBLE_EQ(m.covariance(1, 1), 3.0);  // (1 + 1 + 4) / 2
  EXPECT_DOUBLE_EQ(m.covariance(2, 2), 0.0);
}

TEST(Moments, UseDivisorCountMinusOne) {  // the paper's sample covariance, not 1/n
  EXPECT_DOUBLE_EQ(moments_of({{0, 0, 0}, {1, 0, 0}}).covariance(0, 0), 0.5);
}

TEST(Moments, OfOnePointHaveZeroCovariance) { EXPECT_TRUE(moments_of({{4, 5, 6}}).covariance.isZero(0)); }

// The contract in moments.h. At 5e6 m neighboring doubles are 9e-10 m apart, so rounding the inputs alone moves
// λ_min by about 1e-6 relative at σ = 0.1 mm; sums about the map origin would be wrong by a factor of thousands.
TEST(MomentsProperty, SmallestEigenvalueSurvivesUtmCoordinates) {
  const double near_origin = smallest_eigenvalue(moments_of(noisy_patch(1e-4, {0, 0, 0})));
  const double far_away = smallest_eigenvalue(moments_of(noisy_patch(1e-4, {500'000, 5'000'000, 100})));
  EXPECT_NEAR(far_away / near_origin, 1.0, 1e-5);
}

TEST(MomentsProperty, ScaleWithLengthSquared) {
  std::vector<Eigen::Vector3d> points = noisy_patch(1e-2, {0, 0, 0});
  const double before = smallest_eigenvalue(moments_of(points));
  for (Eigen::Vector3d& point : points) point *= 10;
  EXPECT_NEAR(smallest_eigenvalue(moments_of(points)) / before, 100.0, 1e-9);
}

}  // namespace
}  // namespace trysquare
