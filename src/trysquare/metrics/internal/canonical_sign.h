// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace trysquare {

/// Of n and −n, which are one normal, the one whose last component that is not 0 is positive: upwards where z is up.
inline Eigen::Vector3d with_canonical_sign(const Eigen::Vector3d& normal) {
  for (Eigen::Index axis = 2; axis >= 0; --axis) {
    if (normal[axis] != 0) return normal[axis] < 0 ? Eigen::Vector3d(-normal) : normal;
  }
  return normal;
}

}  // namespace trysquare
