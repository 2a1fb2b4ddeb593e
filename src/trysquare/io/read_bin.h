// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/point_table.h"

#include <string_view>

namespace trysquare {

/// KITTI's velodyne/*.bin: x, y, z, intensity as little-endian float32, 16 bytes a point, no header.
/// @param name      what messages call the bytes: the path, usually.
/// @throws IoError  if there is no byte at all, or not a whole number of points.
/// Source: Geiger et al., "Vision meets Robotics: The KITTI Dataset", 2013.
PointTable parse_kitti_bin(std::string_view bytes, std::string_view name, Columns columns);

/// nuScenes' LIDAR_TOP/*.pcd.bin: x, y, z, intensity, ring as little-endian float32, 20 bytes a point, no header.
/// @throws IoError  as above.
/// Source: Caesar et al., "nuScenes: A multimodal dataset for autonomous driving", 2020.
PointTable parse_nuscenes_bin(std::string_view bytes, std::string_view name, Columns columns);

}  // namespace trysquare
