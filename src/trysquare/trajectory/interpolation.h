// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/pose.h"
#include "trysquare/core/trajectory.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace trysquare {

/// The pose at the share `share` in [0, 1] of the way from `a` to `b`: the position on the straight line, the rotation
/// on the shortest arc at constant speed (SLERP). At 0 and 1 it is `a` and `b` as they are. Source: Shoemake, Animating
/// rotation with quaternion curves, 1985.
Pose interpolated(const Pose& a, const Pose& b, double share);

/// Poses of a trajectory at any time between its first and its last.
class PoseInterpolator {
 public:
  /// @param trajectory  With a time stamp per pose, in any order; of equal stamps the earliest index counts.
  /// @throws InvalidArgument  if it has no poses or no stamps.
  explicit PoseInterpolator(const Trajectory& trajectory);

  /// What is known about a point in time.
  enum class Place {
    kInside,   ///< Between two poses that are near enough to each other, or at a pose.
    kInGap,    ///< Between two poses that are further apart than the largest gap.
    kOutside,  ///< Before the first pose or after the last.
  };
  struct Answer {
    Place place = Place::kOutside;
    Pose world_from_scan{};       ///< Of kInside.
    std::int64_t nearest_ns = 0;  ///< The stamp of the trajectory that is nearest.
  };

  /// Never extrapolates.
  Answer at(std::int64_t stamp_ns, std::int64_t max_gap_ns) const;

 private:
  std::vector<std::int64_t> stamps_ns_;  ///< Ascending, each once.
  std::vector<Pose> poses_;
};

}  // namespace trysquare
