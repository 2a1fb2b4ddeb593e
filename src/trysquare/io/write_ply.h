// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/point_table.h"

#include <filesystem>

namespace trysquare {

/// Writes points as binary little-endian PLY: x, y, z as double, each column as `float scalar_<name>`, which
/// CloudCompare shows at once, and colors, if there are any, as `uchar` red, green, blue. The file is written in
/// pieces, beside the old one, and then takes its place.
/// @param table  columns, and colors unless there are none, as long as `points`. White space in a name becomes `_`; a
/// name that starts with scalar_ stays.
/// @throws InvalidArgument  if a column or the colors have another length than `points`.
/// @throws IoError          if the file cannot be written.
void write_ply(const std::filesystem::path& path, const PointTable& table);

}  // namespace trysquare
