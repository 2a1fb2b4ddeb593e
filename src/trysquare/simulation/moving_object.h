// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/pose.h"
#include "trysquare/core/triangle_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace trysquare {

/// A thing that moves along a path and turns with it: a car.
struct MovingObject {
  TriangleMesh mesh_in_object;                   ///< x ahead, z up.
  std::vector<Eigen::Vector3d> path_in_world{};  ///< >= 2 points [m]. A closed one ends where it begins; an open one is
                                                 ///< driven again from its beginning.
  double start_m = 0;                            ///< Where along the path it is at time 0.
  double speed_mps = 0;                          ///< [m/s]

  /// Where it is.
  Pose world_from_object(double time_s) const;
};

}  // namespace trysquare
