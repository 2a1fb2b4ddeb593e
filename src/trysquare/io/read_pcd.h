// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/point_table.h"

#include <string_view>

namespace trysquare {

/// PCD, the format of the Point Cloud Library, v0.5 to v0.7: DATA ascii, binary and binary_compressed (LZF), fields of
/// TYPE F (SIZE 4, 8), I and U (SIZE 1, 2, 4, 8). A field of COUNT n > 1 becomes the columns name_0 ... name_<n-1>;
/// fields called `_` are padding. VIEWPOINT is not applied. POINTS 0 is a valid, empty cloud.
/// @param name      what messages call the bytes: the path, usually.
/// @throws IoError  naming the line of the header or of a point, or the byte; before any memory is taken for points
///                  that the bytes cannot hold.
/// Source: https://pointclouds.org/documentation/tutorials/pcd_file_format.html
PointTable parse_pcd(std::string_view bytes, std::string_view name, Columns columns);

}  // namespace trysquare
