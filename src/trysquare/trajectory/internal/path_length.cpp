// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/internal/path_length.h"

#include <cmath>

namespace trysquare::internal {

double step_length(const Pose& a, const Pose& b) {
  const Eigen::Vector3d d = b.translation - a.translation;
  return std::sqrt(d.x() * d.x() + d.y() * d.y() + d.z() * d.z());
}

std::vector<double> path_lengths(const Trajectory& trajectory) {
  std::vector<double> path_m(trajectory.size(), 0.0);
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    path_m[i] = path_m[i - 1] + step_length(trajectory.world_from_scan[i - 1], trajectory.world_from_scan[i]);
  }
  return path_m;
}

}  // namespace trysquare::internal
