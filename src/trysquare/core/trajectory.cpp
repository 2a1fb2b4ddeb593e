// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/trajectory.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

namespace trysquare {

void require_pose_per_scan(const Trajectory& trajectory, std::size_t num_scans) {
  if (num_scans != trajectory.size()) {
    throw InvalidArgument(
        fmt::format("{} scans but {} poses: there must be one pose per scan", num_scans, trajectory.size()));
  }
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const Pose& pose = trajectory.world_from_scan[i];
    if (!pose.translation.allFinite()) throw InvalidArgument(fmt::format("pose {}: the translation is not finite", i));
    if (const double error = rotation_error(pose.rotation); !(error < kRotationErrorLimit)) {
      throw InvalidArgument(fmt::format("pose {}: not a rotation: it is off by {:.3g}, the limit is {:g}", i, error,
                                        kRotationErrorLimit));
    }
  }
}

}  // namespace trysquare
