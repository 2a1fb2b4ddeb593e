// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/projection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace trysquare {
namespace {

constexpr std::array<std::pair<Plane, std::string_view>, 3> kPlanes{{
    {Plane::kXy, "xy"},
    {Plane::kXz, "xz"},
    {Plane::kYz, "yz"},
}};

/// Roll, pitch, yaw of R = Rz(yaw)·Ry(pitch)·Rx(roll) [rad]; yaw is 0 where the pitch is ±90°.
Eigen::Vector3d roll_pitch_yaw(const Eigen::Matrix3d& r) {
  const double cosine_pitch = std::sqrt(r(0, 0) * r(0, 0) + r(1, 0) * r(1, 0));
  const double pitch = std::atan2(-r(2, 0), cosine_pitch);
  if (cosine_pitch > 4 * std::numeric_limits<double>::epsilon()) {
    return {std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))};
  }
  return {std::atan2(-r(1, 2), r(1, 1)), pitch, 0};
}

}  // namespace

std::string_view name_of(Plane plane) { return kPlanes[static_cast<std::size_t>(plane)].second; }

std::optional<Plane> plane_named(std::string_view name) {
  const auto* found = std::find_if(kPlanes.begin(), kPlanes.end(), [&](const auto& e) { return e.second == name; });
  if (found == kPlanes.end()) return std::nullopt;
  return found->first;
}

Trajectory projected(const Trajectory& trajectory, Plane plane) {
  const Eigen::Index normal = plane == Plane::kXy ? 2 : plane == Plane::kXz ? 1 : 0;
  Trajectory result = trajectory;
  for (Pose& pose : result.world_from_scan) {
    const double angle_rad = roll_pitch_yaw(pose.rotation)[normal];
    pose.rotation = Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::Unit(normal)).toRotationMatrix();
    pose.translation[normal] = 0;
  }
  return result;
}

}  // namespace trysquare
