// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace trysquare {

/// What a point file holds: N points and, beside them, named columns of N numbers (intensity, ring, plane variance
/// ...). Points are as the file has them, NaN and (0, 0, 0) included.
struct PointTable {
  struct Column {
    std::string name;
    std::vector<double> values;  ///< N numbers.
  };

  std::vector<Eigen::Vector3d> points;  ///< [m], in the frame of the file.
  std::vector<Column> columns;
  std::vector<std::array<std::uint8_t, 3>> colors{};  ///< Red, green, blue for writers: none, or N. Readers leave it.
};

/// Which columns a reader keeps.
enum class Columns { kNone, kAll };

}  // namespace trysquare
