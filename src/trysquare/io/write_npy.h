// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace trysquare {

/// Doubles as the bytes of a .npy file, version 1.0, little endian: a vector, or with `num_columns` > 0 a matrix, row
/// by row. REQUIRES: values.size() is a multiple of num_columns.
std::string format_npy(std::span<const double> values, std::size_t num_columns = 0);

}  // namespace trysquare
