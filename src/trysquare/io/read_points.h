// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/scan.h"
#include "trysquare/io/point_table.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace trysquare {

/// The formats of points that can be read.
enum class PointFormat { kKittiBin, kNuScenesBin, kPcd, kPly, kXyz, kNpy };

/// The format that the end of a file's name stands for, if any: .pcd.bin is nuScenes, .bin is KITTI, .pcd, .ply, .npy,
/// and .xyz .txt .csv .asc .pts are text. Letter case does not matter.
std::optional<PointFormat> known_point_format(const std::filesystem::path& path);

/// As above.
/// @throws IoError  naming the endings that are known.
PointFormat point_format_of(const std::filesystem::path& path);

/// The one reader of all formats; see read_bin.h, read_pcd.h, read_ply.h, read_xyz.h and read_npy.h. Pure: touches no
/// file.
/// @param name      what messages call the bytes: the path, usually.
/// @throws IoError  `<name>: <line N | byte N>: <what was found, what was expected>`.
PointTable parse_points(std::string_view bytes, PointFormat format, std::string_view name, Columns columns);

/// @throws IoError  if the file is missing, of no known format, or malformed.
PointTable read_points(const std::filesystem::path& path, Columns columns = Columns::kAll);

/// One scan. Points that are not finite, and points exactly at (0, 0, 0), which are invalid returns, are dropped and
/// counted (docs/definitions.md#dropped-points).
/// @throws IoError  as read_points.
Scan read_scan(const std::filesystem::path& path);

/// A registered map, where (0, 0, 0) is a place like any other: points at the origin are counted but kept, points that
/// are not finite are dropped and counted.
/// @throws IoError  as read_points.
Scan read_map(const std::filesystem::path& path);

}  // namespace trysquare
