// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"

#include <Eigen/Geometry>

#include <cmath>

/// Trajectories for the tests of this folder.
namespace trysquare::test {

/// A winding run of n poses that turns about changing axes.
inline Trajectory winding(int n) {
  Trajectory trajectory;
  for (int i = 0; i < n; ++i) {
    const Eigen::AngleAxisd rotation(0.1 * i, Eigen::Vector3d(0.2, std::cos(i), 1).normalized());
    trajectory.world_from_scan.push_back(
        {rotation.toRotationMatrix(), {0.8 * i, 3 * std::sin(0.4 * i), std::cos(0.7 * i)}});
  }
  return trajectory;
}

/// `trajectory` with errors that differ from pose to pose: up to 0.05 · size rad and 0.2 · size m an axis.
inline Trajectory disturbed(Trajectory trajectory, double size = 1) {
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const double phase = static_cast<double>(i * i);
    Pose& pose = trajectory.world_from_scan[i];
    pose.rotation = pose.rotation * Eigen::AngleAxisd(0.05 * size * std::sin(phase),
                                                      Eigen::Vector3d(1, std::cos(phase), 0.5).normalized());
    pose.translation += 0.2 * size * Eigen::Vector3d(std::sin(3 * phase), std::cos(5 * phase), std::sin(7 * phase));
  }
  return trajectory;
}

}  // namespace trysquare::test
