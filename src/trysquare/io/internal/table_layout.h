// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/internal/scalars.h"
#include "trysquare/io/point_table.h"

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trysquare::internal {

/// The longest descriptor in use (GASD with colors) has 7992 values a point. More are refused, because a short header
/// can claim them, and names and columns take memory even without points.
inline constexpr std::size_t kMaxValuesPerPoint = 8192;

/// Which value of a file's record becomes a coordinate, and which ones a column.
struct TableLayout {
  std::size_t num_values = 0;               ///< In a record.
  std::array<std::size_t, 3> coordinate{};  ///< Indices of x, y, z.
  std::vector<std::size_t> column;          ///< Indices of the values that are kept as columns.
  std::vector<std::string> column_names;
};

/// @param value_names  in the order of the record; an empty name is padding. Letter case of x, y, z does not matter.
/// @param where        "<name>: line N", the start of a message.
/// @throws IoError     if x, y or z is missing or there twice.
TableLayout layout_of(const std::vector<std::string>& value_names, Columns columns, std::string_view where);

/// Names of records whose first three values are x, y, z: the others are called column_4, column_5, ...
std::vector<std::string> unnamed_values(std::size_t num_values);

PointTable empty_table(const TableLayout& layout);

/// REQUIRES row.size() == layout.num_values.
void append_row(std::span<const double> row, const TableLayout& layout, PointTable& table);

/// A table of `num_points` points from binary records; scalars_of(i) says where value i of all records is.
PointTable gather_table(const TableLayout& layout, std::size_t num_points,
                        const std::function<StridedScalars(std::size_t value)>& scalars_of);

}  // namespace trysquare::internal
