// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/interpolation.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/rotation_angle.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace trysquare {
namespace {

Eigen::Quaterniond quaternion_of(const Eigen::Matrix3d& rotation) {
  return Eigen::Quaterniond(quaternion_direction(rotation).normalized());
}

/// |a − b|, which need not fit into a signed number.
std::uint64_t distance(std::int64_t a, std::int64_t b) {
  return a < b ? static_cast<std::uint64_t>(b) - static_cast<std::uint64_t>(a)
               : static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b);
}

}  // namespace

Pose interpolated(const Pose& a, const Pose& b, double share) {
  if (share <= 0) return a;
  if (share >= 1) return b;
  return {quaternion_of(a.rotation).slerp(share, quaternion_of(b.rotation)).toRotationMatrix(),
          a.translation + share * (b.translation - a.translation)};
}

PoseInterpolator::PoseInterpolator(const Trajectory& trajectory) {
  if (trajectory.size() == 0 || trajectory.stamps_ns.size() != trajectory.size()) {
    throw InvalidArgument(
        fmt::format("the trajectory to interpolate has {} poses and {} time stamps, expected one for "
                    "each of one or more poses",
                    trajectory.size(), trajectory.stamps_ns.size()));
  }
  std::vector<std::size_t> order(trajectory.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return trajectory.stamps_ns[a] < trajectory.stamps_ns[b]; });
  for (const std::size_t i : order) {
    if (!stamps_ns_.empty() && stamps_ns_.back() == trajectory.stamps_ns[i]) continue;
    stamps_ns_.push_back(trajectory.stamps_ns[i]);
    poses_.push_back(trajectory.world_from_scan[i]);
  }
}

PoseInterpolator::Answer PoseInterpolator::at(std::int64_t stamp_ns, std::int64_t max_gap_ns) const {
  const auto after = std::lower_bound(stamps_ns_.begin(), stamps_ns_.end(), stamp_ns);
  const auto index = static_cast<std::size_t>(after - stamps_ns_.begin());
  if (after == stamps_ns_.end()) return {.place = Place::kOutside, .nearest_ns = stamps_ns_.back()};
  if (*after == stamp_ns) return {Place::kInside, poses_[index], stamp_ns};
  if (index == 0) return {.place = Place::kOutside, .nearest_ns = stamps_ns_.front()};
  const std::int64_t before_ns = stamps_ns_[index - 1];
  const std::int64_t nearest_ns = distance(before_ns, stamp_ns) <= distance(stamp_ns, *after) ? before_ns : *after;
  if (distance(before_ns, *after) > static_cast<std::uint64_t>(max_gap_ns)) {
    return {.place = Place::kInGap, .nearest_ns = nearest_ns};
  }
  const double share =
      static_cast<double>(distance(before_ns, stamp_ns)) / static_cast<double>(distance(before_ns, *after));
  return {Place::kInside, interpolated(poses_[index - 1], poses_[index], share), nearest_ns};
}

}  // namespace trysquare
