// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/rotation_angle.h"

#include <cmath>

namespace trysquare {

Eigen::Vector4d quaternion_direction(const Eigen::Matrix3d& rotation) {
  const double trace = rotation.trace();
  Eigen::Index i = 0;
  const double largest = rotation.diagonal().maxCoeff(&i);
  const auto skew = [&](Eigen::Index k) {
    const Eigen::Index a = (k + 1) % 3;
    const Eigen::Index b = (k + 2) % 3;
    return rotation(b, a) - rotation(a, b);
  };
  if (trace > largest) return {skew(0), skew(1), skew(2), 1 + trace};
  const Eigen::Index j = (i + 1) % 3;
  const Eigen::Index k = (i + 2) % 3;
  Eigen::Vector4d quaternion;
  quaternion[i] = 1 - trace + 2 * largest;
  quaternion[j] = rotation(j, i) + rotation(i, j);
  quaternion[k] = rotation(k, i) + rotation(i, k);
  quaternion[3] = skew(i);
  return quaternion;
}

double rotation_angle(const Eigen::Matrix3d& rotation) { return rotation_angle(quaternion_direction(rotation)); }

double rotation_angle(const Eigen::Vector4d& quaternion) {
  return 2 * std::atan2(quaternion.head<3>().norm(), std::abs(quaternion[3]));
}

}  // namespace trysquare
