// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/pose.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trysquare {
namespace {

Pose example() {
  return {Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix(), {10, -20, 30}};
}

TEST(Pose, MapsPointsByRotationThenTranslation) {
  const Pose quarter_turn{(Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished(), {1, 2, 3}};
  EXPECT_EQ(quarter_turn * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 3, 3));
}

TEST(Pose, ProductAppliesTheRightFactorFirst) {
  const Pose a = example();
  const Pose b{Eigen::Matrix3d::Identity(), {1, 0, 0}};
  const Eigen::Vector3d p(0.5, 0.6, 0.7);
  EXPECT_LT(((a * b) * p - a * (b * p)).norm(), 1e-14);
}

TEST(Pose, InversesAgreeForRotations) {
  const Pose pose = example();
  EXPECT_LT((general_inverse(pose).rotation - rigid_inverse(pose).rotation).norm(), 1e-15);
  EXPECT_LT((general_inverse(pose) * (pose * Eigen::Vector3d(1, 2, 3)) - Eigen::Vector3d(1, 2, 3)).norm(), 1e-13);
}

// KITTI's files are orthonormal to 1e-7 only. The two inverses must differ there: the general one undoes the matrix.
TEST(Pose, GeneralInverseUndoesMatricesThatAreNotRotations) {
  Pose scaled = example();
  scaled.rotation *= 1.001;
  const Eigen::Vector3d p(1, 2, 3);
  EXPECT_LT((general_inverse(scaled) * (scaled * p) - p).norm(), 1e-13);
  EXPECT_GT((rigid_inverse(scaled) * (scaled * p) - p).norm(), 1e-3);
}

TEST(Pose, RotationErrorMeasuresTheDistanceToOrthonormal) {
  EXPECT_LT(rotation_error(example().rotation), 1e-15);
  EXPECT_NEAR(rotation_error(1.001 * Eigen::Matrix3d::Identity()), 0.002001, 1e-12);
}

TEST(Pose, RotationErrorOfReflectionsAndNansIsInfinite) {
  EXPECT_TRUE(std::isinf(rotation_error(-Eigen::Matrix3d::Identity())));
  EXPECT_TRUE(std::isinf(rotation_error(Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN()))));
}

}  // namespace
}  // namespace trysquare
