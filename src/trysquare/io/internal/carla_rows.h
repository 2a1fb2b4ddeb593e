// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/internal/pose_collector.h"

#include <string_view>

namespace trysquare::internal {

/// Whether a text looks like transforms of CARLA: JSON, or a CSV header that names `frame`, and `yaw` or `m00`.
bool looks_like_carla(std::string_view text);

/// Adds the transforms of a recording, JSON or CSV, as they stand: world_from_actor of a left-handed world, x forward,
/// y right, z up. The columns and keys are those of docs/user/carla.md.
/// @throws IoError  naming the line of a CSV; the byte, or the item from 1, of a JSON.
void collect_carla(std::string_view text, std::string_view name, PoseCollector& poses);

}  // namespace trysquare::internal
