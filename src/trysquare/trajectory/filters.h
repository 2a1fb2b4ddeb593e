// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace trysquare {

/// At most `num_poses` poses, evenly spread by index, the first and the last among them; fewer stay as they are.
/// @throws InvalidArgument  if num_poses is 0.
Trajectory downsampled(const Trajectory& trajectory, std::size_t num_poses);

/// The first pose, and each that has moved by `distance_m` along the path, or turned by `angle_rad`, since the last one
/// that was kept.
/// @throws InvalidArgument  if a threshold is negative or not finite.
Trajectory motion_filtered(const Trajectory& trajectory, double distance_m, double angle_rad);

/// The poses from `first_ns` to `last_ns`, both inclusive; what is not given does not limit.
/// @throws InvalidArgument  if the trajectory has no time stamps, or no pose is left.
Trajectory in_time_range(const Trajectory& trajectory, std::optional<std::int64_t> first_ns,
                         std::optional<std::int64_t> last_ns);

}  // namespace trysquare
