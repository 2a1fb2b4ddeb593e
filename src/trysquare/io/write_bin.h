// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"

#include <filesystem>

namespace trysquare {

/// Writes a scan as KITTI's .bin: x, y, z rounded to float32, and an intensity of 0. Whole or not at all.
/// @throws IoError  if the file cannot be written.
void write_kitti_bin(const std::filesystem::path& path, PointsView points_in_scan);

}  // namespace trysquare
