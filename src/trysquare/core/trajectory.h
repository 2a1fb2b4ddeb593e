// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/pose.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trysquare {

/// Poses of one sensor, in the order of its scans, with time stamps when the file has them.
struct Trajectory {
  std::vector<Pose> world_from_scan;    ///< M poses: point_in_world = world_from_scan[i] * point_in_scan.
  std::vector<std::int64_t> stamps_ns;  ///< M time stamps, or empty when the format has none.

  std::size_t size() const { return world_from_scan.size(); }
};

/// Checks that scans and poses belong together before anything is made of them.
///
/// @param num_scans         Scans that the poses are of.
/// @throws InvalidArgument  if there is not one pose per scan, or a pose is not a finite translation and a rotation
///                          (rotation_error() >= kRotationErrorLimit).
void require_pose_per_scan(const Trajectory& trajectory, std::size_t num_scans);

}  // namespace trysquare
