// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/orthogonal_subset.h"

namespace trysquare {

OrthogonalSubset transformed(const Pose& b_from_a, OrthogonalSubset subset_in_a) {
  for (OrthogonalSubset::Direction& direction : subset_in_a.directions) {
    direction.normal_in_map = b_from_a.rotation * direction.normal_in_map;
    for (Eigen::Vector3d& point : direction.points_in_map) point = b_from_a * point;
  }
  return subset_in_a;
}

}  // namespace trysquare
