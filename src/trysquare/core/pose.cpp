// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/pose.h"

#include <Eigen/LU>

#include <limits>

namespace trysquare {

Pose general_inverse(const Pose& b_from_a) {
  const Eigen::Matrix3d inverse = b_from_a.rotation.inverse();
  return {inverse, -(inverse * b_from_a.translation)};
}

Pose rigid_inverse(const Pose& b_from_a) {
  return {b_from_a.rotation.transpose(), -(b_from_a.rotation.transpose() * b_from_a.translation)};
}

double rotation_error(const Eigen::Matrix3d& rotation) {
  if (!rotation.allFinite() || rotation.determinant() <= 0) return std::numeric_limits<double>::infinity();
  return (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

}  // namespace trysquare
