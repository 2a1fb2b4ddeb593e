// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/handedness.h"

namespace trysquare {

Pose with_y_negated(const Pose& b_from_a) {
  Pose result = b_from_a;
  result.rotation.row(1) *= -1;
  result.rotation.col(1) *= -1;  // the entry in the middle has both, and stays
  result.translation.y() *= -1;
  return result;
}

Trajectory with_y_negated(Trajectory trajectory) {
  for (Pose& pose : trajectory.world_from_scan) pose = with_y_negated(pose);
  return trajectory;
}

void negate_y(std::vector<Eigen::Vector3d>& points) {
  for (Eigen::Vector3d& point : points) point.y() *= -1;
}

}  // namespace trysquare
