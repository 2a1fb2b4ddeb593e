// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/filters.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/internal/path_length.h"
#include "trysquare/trajectory/rotation_angle.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace trysquare {
namespace {

Trajectory subset(const Trajectory& trajectory, std::span<const std::size_t> indices) {
  Trajectory result;
  for (const std::size_t i : indices) {
    result.world_from_scan.push_back(trajectory.world_from_scan[i]);
    if (!trajectory.stamps_ns.empty()) result.stamps_ns.push_back(trajectory.stamps_ns[i]);
  }
  return result;
}

void require_threshold(const char* name, double value) {
  if (!(value >= 0 && std::isfinite(value))) {
    throw InvalidArgument(fmt::format("{} = {} is out of range: it must be >= 0", name, value));
  }
}

}  // namespace

Trajectory downsampled(const Trajectory& trajectory, std::size_t num_poses) {
  if (num_poses == 0) throw InvalidArgument("num_poses = 0 is out of range: it must be at least 1");
  if (trajectory.size() <= num_poses) return trajectory;
  std::vector<std::size_t> indices = {0};
  const double step =
      num_poses > 1 ? static_cast<double>(trajectory.size() - 1) / static_cast<double>(num_poses - 1) : 0;
  for (std::size_t k = 1; k < num_poses; ++k) {  // numpy's linspace, cut to integers
    indices.push_back(k + 1 == num_poses ? trajectory.size() - 1
                                         : static_cast<std::size_t>(static_cast<double>(k) * step));
  }
  return subset(trajectory, indices);
}

Trajectory motion_filtered(const Trajectory& trajectory, double distance_m, double angle_rad) {
  require_threshold("distance_m", distance_m);
  require_threshold("angle_rad", angle_rad);
  if (trajectory.size() == 0) return trajectory;
  const std::vector<double> path_m = internal::path_lengths(trajectory);
  const std::vector<Pose>& poses = trajectory.world_from_scan;
  std::vector<std::size_t> kept = {0};
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const std::size_t last = kept.back();
    if (path_m[i] - path_m[last] >= distance_m ||
        rotation_angle(Eigen::Matrix3d(poses[last].rotation.transpose() * poses[i].rotation)) >= angle_rad) {
      kept.push_back(i);
    }
  }
  return subset(trajectory, kept);
}

Trajectory in_time_range(const Trajectory& trajectory, std::optional<std::int64_t> first_ns,
                         std::optional<std::int64_t> last_ns) {
  if (trajectory.stamps_ns.empty())
    throw InvalidArgument("a time range needs time stamps, which the poses do not have");
  const std::int64_t first = first_ns.value_or(std::numeric_limits<std::int64_t>::min());
  const std::int64_t last = last_ns.value_or(std::numeric_limits<std::int64_t>::max());
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (first <= trajectory.stamps_ns[i] && trajectory.stamps_ns[i] <= last) kept.push_back(i);
  }
  if (kept.empty()) throw InvalidArgument(fmt::format("no pose lies in the time range {} to {} ns", first, last));
  return subset(trajectory, kept);
}

}  // namespace trysquare
