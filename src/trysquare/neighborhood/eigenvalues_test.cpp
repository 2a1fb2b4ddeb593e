// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/eigenvalues.h"

#include "trysquare/core/error.h"
#include "trysquare/neighborhood/internal/vector_kernels.h"
#include "trysquare/neighborhood/neighborhood_test_oracle.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace trysquare {
namespace {

Moments with_covariance(const Eigen::Matrix3d& covariance) { return {.count = 10, .covariance = covariance}; }

/// Turned by a random rotation, so that no element is zero.
Eigen::Matrix3d turned(const Eigen::Vector3d& eigenvalues, std::mt19937& rng) {
  std::normal_distribution<double> normal;
  const Eigen::Matrix3d axes =
      Eigen::Quaterniond(normal(rng), normal(rng), normal(rng), normal(rng)).normalized().toRotationMatrix();
  const Eigen::Matrix3d matrix = axes * eigenvalues.asDiagonal() * axes.transpose();
  return (matrix + matrix.transpose()) / 2;
}

/// From spheres to planes and lines whose λ₁ is 1e-12 λ₃, from micrometres to kilometres.
std::vector<Moments> covariances_of_all_shapes() {
  std::mt19937 rng(5);
  std::vector<Moments> moments;
  for (const double scale : {1e-12, 1e-3, 1.0, 1e6}) {
    for (const double flat : {1.0, 1e-2, 1e-6, 1e-12, 0.0}) {
      for (const double narrow : {1.0, 0.5, 1e-6, 1e-12}) {
        for (int i = 0; i < 7; ++i) {  // odd, so that batches are cut everywhere
          moments.push_back(with_covariance(turned(scale * Eigen::Vector3d(flat * narrow, narrow, 1), rng)));
        }
      }
    }
  }
  return moments;
}

class EigenvaluesByKernel : public testing::TestWithParam<std::string> {};

TEST_P(EigenvaluesByKernel, EqualThoseInLongDouble) {
  const std::vector<Moments> moments = covariances_of_all_shapes();
  std::vector<Eigen::Vector3d> result(moments.size());
  test::kernels_named(GetParam()).eigenvalues(moments, result);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const auto exact = test::exact_eigenvalues(moments[i].covariance.cast<long double>());
    for (int k = 0; k < 3; ++k) {
      const auto off = static_cast<double>(result[i][k] - std::max(exact[k], 0.0L));
      EXPECT_LE(std::abs(off), 1e-15 * static_cast<double>(exact[2])) << "matrix " << i << ", eigenvalue " << k;
    }
  }
}

TEST_P(EigenvaluesByKernel, OfDiagonalsAreExactAndAscending) {
  const std::vector<Moments> moments = {with_covariance(Eigen::Vector3d(4, 1, 2).asDiagonal()),
                                        with_covariance(Eigen::Vector3d(3, 3, 3).asDiagonal()),
                                        with_covariance(Eigen::Matrix3d::Zero())};
  std::vector<Eigen::Vector3d> result(3);
  test::kernels_named(GetParam()).eigenvalues(moments, result);
  EXPECT_TRUE(result[0].isApprox(Eigen::Vector3d(1, 2, 4), 1e-15));
  EXPECT_TRUE(result[1].isApprox(Eigen::Vector3d(3, 3, 3), 1e-15));
  EXPECT_EQ(result[2], Eigen::Vector3d::Zero());
}

TEST_P(EigenvaluesByKernel, AreNeverNegative) {
  Eigen::Matrix3d indefinite = Eigen::Vector3d(1, 1, -1e-17).asDiagonal();
  std::vector<Eigen::Vector3d> result(1);
  test::kernels_named(GetParam()).eigenvalues(std::vector<Moments>{with_covariance(indefinite)}, result);
  EXPECT_EQ(result[0][0], 0.0);
}

INSTANTIATE_TEST_SUITE_P(Vector, EigenvaluesByKernel, testing::ValuesIn(test::names_of_kernels()));

TEST(EigenvaluesArguments, RefuseRoomOfAnotherLength) {
  const std::vector<Moments> moments(2);
  std::vector<Eigen::Vector3d> room(1);
  EXPECT_THROW(eigenvalues(moments, room), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
