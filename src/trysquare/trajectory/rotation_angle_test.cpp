// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/rotation_angle.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trysquare {
namespace {

using std::numbers::pi;

/// Axes that make each of the four components of the quaternion the largest at some angle.
const Eigen::Vector3d kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.8, -0.5, 0.3}, {-0.1, 0.9, -0.4}, {0.3, 0.2, 0.9}};

TEST(RotationAngle, IsTheAngleThatMadeTheMatrixAtEverySize) {
  for (const Eigen::Vector3d& axis : kAxes) {
    for (const double angle : {1e-14, 1e-9, 1e-6, 1e-3, 0.5, 1.5, 2.0, 3.0, pi - 1e-3, pi - 1e-6}) {
      const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
      EXPECT_NEAR(rotation_angle(rotation), angle, 1e-15 + 4e-16 * angle) << "axis " << axis.transpose();
    }
  }
}

TEST(RotationAngle, IsNeverNegativeAndAtMostHalfATurn) {
  for (const Eigen::Vector3d& axis : kAxes) {
    EXPECT_NEAR(rotation_angle(Eigen::AngleAxisd(-0.3, axis.normalized()).toRotationMatrix()), 0.3, 1e-15);
    EXPECT_NEAR(rotation_angle(Eigen::AngleAxisd(pi + 0.1, axis.normalized()).toRotationMatrix()), pi - 0.1, 1e-14);
  }
}

TEST(RotationAngle, OfTheIdentityIsExactlyZero) {
  EXPECT_EQ(rotation_angle(Eigen::Matrix3d(Eigen::Matrix3d::Identity())), 0);
}

TEST(RotationAngle, DoesNotSeeTheSignOrTheLengthOfAQuaternion) {
  const Eigen::Vector4d quaternion(0.1, -0.2, 0.3, 0.9);
  EXPECT_DOUBLE_EQ(rotation_angle(Eigen::Vector4d(-7 * quaternion)), rotation_angle(quaternion));
}

TEST(QuaternionDirection, TurnsVectorsAsItsMatrixDoes) {
  for (const Eigen::Vector3d& axis : kAxes) {
    for (const double angle : {1e-6, 0.4, 1.7, 2.5, 3.1, pi}) {
      const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
      const Eigen::Quaterniond quaternion(quaternion_direction(rotation).normalized());
      EXPECT_LT((quaternion.toRotationMatrix() - rotation).cwiseAbs().maxCoeff(), 1e-15);
    }
  }
}

// KITTI's rotations are orthonormal to 1e-7. evo reads the quaternion off such a matrix; the trace and the skew part in
// one arc tangent differ from it by 1e-8 relative, ten times what the comparison with evo allows.
TEST(RotationAngle, OfAMatrixThatIsNearlyARotationIsThatOfItsQuaternion) {
  const double angle = 0.02;
  Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  rotation *= 1 + 1e-7;
  // By hand: (0, 0, 2 s sin a) and 1 + (s + 2 s cos a) with s = 1 + 1e-7.
  const double s = 1 + 1e-7;
  EXPECT_NEAR(rotation_angle(rotation), 2 * std::atan2(2 * s * std::sin(angle), 1 + s + 2 * s * std::cos(angle)),
              1e-17);
  EXPECT_GT(std::abs(rotation_angle(rotation) / angle - 1), 1e-8);
}

}  // namespace
}  // namespace trysquare
