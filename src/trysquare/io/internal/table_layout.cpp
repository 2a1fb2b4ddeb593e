// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/table_layout.h"

#include "trysquare/core/error.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>

#include <optional>

namespace trysquare::internal {
namespace {

constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};

std::optional<std::size_t> axis_named(std::string_view name) {
  const std::string lower = lower_case(name);
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    if (lower == kAxes[axis]) return axis;
  }
  return std::nullopt;
}

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMaxListed = 12;
  std::string list;
  for (std::size_t i = 0; i < names.size() && i < kMaxListed; ++i) list += (i > 0 ? " " : "") + in_quotes(names[i]);
  return list + (names.size() > kMaxListed ? " …" : "");
}

}  // namespace

TableLayout layout_of(const std::vector<std::string>& value_names, Columns columns, std::string_view where) {
  TableLayout layout;
  layout.num_values = value_names.size();
  std::array<bool, 3> found{};
  for (std::size_t value = 0; value < value_names.size(); ++value) {
    if (const std::optional<std::size_t> axis = axis_named(value_names[value])) {
      if (found[*axis]) throw IoError(fmt::format("{}: there are two fields {}, expected one", where, kAxes[*axis]));
      found[*axis] = true;
      layout.coordinate[*axis] = value;
    } else if (columns == Columns::kAll && !value_names[value].empty()) {
      layout.column.push_back(value);
      layout.column_names.push_back(value_names[value]);
    }
  }
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    if (!found[axis]) {
      throw IoError(fmt::format("{}: no field {}, expected x, y and z; found {}", where, kAxes[axis],
                                value_names.empty() ? "none" : list_of(value_names)));
    }
  }
  return layout;
}

std::vector<std::string> unnamed_values(std::size_t num_values) {
  std::vector<std::string> names = {"x", "y", "z"};
  names.resize(num_values);
  for (std::size_t value = kAxes.size(); value < num_values; ++value)
    names[value] = fmt::format("column_{}", value + 1);
  return names;
}

PointTable empty_table(const TableLayout& layout) {
  PointTable table;
  for (const std::string& name : layout.column_names) table.columns.push_back({name, {}});
  return table;
}

void append_row(std::span<const double> row, const TableLayout& layout, PointTable& table) {
  table.points.emplace_back(row[layout.coordinate[0]], row[layout.coordinate[1]], row[layout.coordinate[2]]);
  for (std::size_t i = 0; i < layout.column.size(); ++i) table.columns[i].values.push_back(row[layout.column[i]]);
}

PointTable gather_table(const TableLayout& layout, std::size_t num_points,
                        const std::function<StridedScalars(std::size_t value)>& scalars_of) {
  PointTable table = empty_table(layout);
  if (num_points == 0) return table;
  table.points.resize(num_points);
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    copy_scalars(scalars_of(layout.coordinate[axis]), num_points, table.points.front().data() + axis, kAxes.size());
  }
  for (std::size_t i = 0; i < layout.column.size(); ++i) {
    table.columns[i].values.resize(num_points);
    copy_scalars(scalars_of(layout.column[i]), num_points, table.columns[i].values.data(), 1);
  }
  return table;
}

}  // namespace trysquare::internal
