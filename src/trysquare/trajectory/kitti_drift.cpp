// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/kitti_drift.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/internal/path_length.h"
#include "trysquare/trajectory/internal/pose_error.h"
#include "trysquare/trajectory/internal/validate.h"
#include "trysquare/trajectory/rotation_angle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace trysquare {
namespace {

/// Sums of one length, or of all.
struct Sums {
  double translation = 0;     ///< Of metres per metre.
  double rotation_per_m = 0;  ///< Of radians per metre.
  std::size_t count = 0;

  void add(const Sums& other) {
    translation += other.translation;
    rotation_per_m += other.rotation_per_m;
    count += other.count;
  }

  std::optional<Drift> mean() const {
    if (count == 0) return std::nullopt;
    const double n = static_cast<double>(count);
    return Drift{.translation_percent = 100 * translation / n,
                 .rotation_deg_per_100m = 100 * (rotation_per_m / n) * (180 / std::numbers::pi),
                 .num_segments = count};
  }
};

Sums sums_of_length(const Trajectory& reference, const Trajectory& estimate, std::span<const double> path_m,
                    double length_m, std::size_t step) {
  Sums sums;
  for (std::size_t i = 0; i < path_m.size(); i += step) {
    const auto end = std::upper_bound(path_m.begin(), path_m.end(), path_m[i] + length_m);
    if (end == path_m.end()) break;  // later ones are shorter still
    const auto j = static_cast<std::size_t>(end - path_m.begin());
    using internal::relative_pose;
    const Pose motion = relative_pose(reference.world_from_scan[i], reference.world_from_scan[j]);
    const Pose estimated = relative_pose(estimate.world_from_scan[i], estimate.world_from_scan[j]);
    const Pose error = relative_pose(estimated, motion);
    sums.translation += error.translation.norm() / length_m;
    sums.rotation_per_m += rotation_angle(error.rotation) / length_m;
    ++sums.count;
  }
  return sums;
}

}  // namespace

void KittiDriftSettings::validate() const {
  if (step < 1) throw InvalidArgument("step = 0 is out of range: it must be at least 1");
  if (lengths_m.empty()) throw InvalidArgument("lengths_m is empty, expected one length or more");
  for (const double length_m : lengths_m) {
    if (!(length_m > 0 && std::isfinite(length_m))) {
      throw InvalidArgument(fmt::format("lengths_m has {}, which is out of range: it must be > 0", length_m));
    }
  }
  if (!std::is_sorted(lengths_m.begin(), lengths_m.end())) throw InvalidArgument("lengths_m must ascend");
}

KittiDrift kitti_drift(const Trajectory& reference, const Trajectory& estimate, const KittiDriftSettings& settings) {
  settings.validate();
  internal::validate_poses(reference, estimate);
  const std::vector<double> path_m = internal::path_lengths(reference);
  KittiDrift result{.path_length_m = path_m.back()};
  Sums all;
  for (const double length_m : settings.lengths_m) {
    const Sums sums = sums_of_length(reference, estimate, path_m, length_m, settings.step);
    all.add(sums);
    result.by_length.push_back({length_m, sums.mean()});
  }
  result.mean = all.mean();
  if (!result.mean) {
    result.reason =
        fmt::format("the path of the reference is {:.6g} m, not longer than the shortest length of {:.6g} m",
                    path_m.back(), settings.lengths_m.front());
  }
  return result;
}

}  // namespace trysquare
