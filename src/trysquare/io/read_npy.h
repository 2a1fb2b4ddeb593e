// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/point_table.h"

#include <string_view>

namespace trysquare {

/// NumPy's .npy, versions 1 to 3: an array of float32 or float64 of shape (N, k), k >= 3, little or big endian, in C or
/// Fortran order. Its columns are x, y, z, column_4, column_5, ... Arrays of objects are pickles, which can run code
/// when they are read: they are refused.
/// @param name      what messages call the bytes: the path, usually.
/// @throws IoError  naming the byte.
/// Source: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
PointTable parse_npy(std::string_view bytes, std::string_view name, Columns columns);

}  // namespace trysquare
