// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/point_table.h"

#include <string_view>

namespace trysquare {

/// PLY 1.0, ascii and binary of both byte orders. Points are the element `vertex` with the properties x, y, z; its
/// other scalar properties become columns; lists, other elements before it and everything behind it are skipped.
/// `element vertex 0` is a valid, empty cloud.
/// @param name      what messages call the bytes: the path, usually.
/// @throws IoError  naming the line of the header or of a point, or the byte; before any memory is taken for points
///                  that the bytes cannot hold.
/// Source: Greg Turk, "The PLY Polygon File Format", 1994.
PointTable parse_ply(std::string_view bytes, std::string_view name, Columns columns);

}  // namespace trysquare
