// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/point_table.h"

#include <string_view>

namespace trysquare {

/// Points as text (.xyz .txt .csv .asc .pts): one a line, numbers parted by white space, commas or semicolons; comments
/// behind # and //. A first line that is not numbers names the columns; so does a comment just above the first point
/// when it has as many names and x, y, z are among them (CloudCompare writes it so). Else the first three columns are
/// x, y, z and the others column_4, column_5, ... A first line with one whole number is the number of points (Leica
/// PTS).
/// @param name      what messages call the text: the path, usually.
/// @throws IoError  naming the line.
PointTable parse_xyz(std::string_view text, std::string_view name, Columns columns);

}  // namespace trysquare
