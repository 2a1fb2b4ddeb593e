// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_xyz.h"

#include "trysquare/io/internal/table_layout.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace trysquare {
namespace {

using internal::fail_at_byte;
using internal::fail_at_line;
using internal::TableLayout;
using internal::trimmed;

/// `x [m], "y", Intensity` are x, y, Intensity: a name is the first word of its field, without quotes.
std::vector<std::string> column_names(std::string_view line) {
  const std::string_view separators = line.find_first_of(",;") == std::string_view::npos ? " \t" : ",;";
  std::vector<std::string> names;
  for (std::string_view rest = trimmed(line); !rest.empty() && names.size() <= internal::kMaxValuesPerPoint;) {
    const std::size_t end = std::min(rest.find_first_of(separators), rest.size());
    std::string_view name = trimmed(rest.substr(0, end));
    if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = trimmed(name.substr(1, name.size() - 2));
    names.emplace_back(name.substr(0, name.find(' ')));
    rest = trimmed(rest.substr(std::min(end + 1, rest.size())));
  }
  return names;
}

bool names_coordinates(const std::vector<std::string>& names) {
  const auto has = [&](std::string_view axis) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return internal::lower_case(name) == axis; });
  };
  return has("x") && has("y") && has("z");
}

class XyzReader {
 public:
  XyzReader(std::string_view text, std::string_view name, Columns columns)
      : text_(text), name_(name), columns_(columns), lines_(text) {}

  PointTable read() {
    for (std::string_view line; lines_.next(line);) {
      const std::string_view content = trimmed(internal::without_comment(line));
      if (content.empty()) {
        if (!layout_ && !trimmed(line).empty()) comment_ = line;
      } else {
        read_line(content);
      }
    }
    if (!layout_ && !num_points_) {
      fail_at_byte(name_, text_.size(), text_.empty() ? "the file is empty, expected points" : "found no points");
    }
    if (num_points_ && table_.points.size() != static_cast<std::size_t>(*num_points_)) {
      fail_at_byte(name_, text_.size(),
                   fmt::format("the file ends after {} points, expected {} as its first line says",
                               table_.points.size(), *num_points_));
    }
    return std::move(table_);
  }

 private:
  void read_line(std::string_view content) {
    if (!layout_ && read_opening(content)) return;
    internal::read_numbers(name_, lines_.line_number(), content, row_);
    if (row_.size() != layout_->num_values) {
      fail_at_line(name_, lines_.line_number(),
                   fmt::format("found {} values, expected {}", row_.size(), layout_->num_values));
    }
    internal::append_row(row_, *layout_, table_);
  }

  /// Learns from the first lines what the columns are. True when the line holds no point.
  bool read_opening(std::string_view content) {
    if (content.find(',') != std::string_view::npos && content.find(';') != std::string_view::npos) {
      fail_at_line(name_, lines_.line_number(), "found commas and semicolons; decimal commas are not understood");
    }
    std::vector<std::string_view> fields;
    internal::split_fields(content, fields);
    const bool is_count = fields.size() == 1 && !num_points_ && internal::parse_integer(fields[0]).value_or(-1) >= 0;
    if (is_count) {
      num_points_ = internal::parse_integer(fields[0]);
      return true;
    }
    if (!internal::parse_double(fields[0])) {
      set_layout(column_names(content));
      return true;
    }
    require_few_columns(fields.size());
    const std::size_t comment_text = std::min(comment_.find_first_not_of("#/ \t"), comment_.size());
    std::vector<std::string> names = column_names(comment_.substr(comment_text));
    if (names.size() != fields.size() || !names_coordinates(names)) {
      if (fields.size() < 3) {
        fail_at_line(name_, lines_.line_number(), fmt::format("found {} values, expected x y z", fields.size()));
      }
      names = internal::unnamed_values(fields.size());
    }
    set_layout(names);
    return false;
  }

  void require_few_columns(std::size_t num_columns) const {
    if (num_columns > internal::kMaxValuesPerPoint) {
      fail_at_line(name_, lines_.line_number(),
                   fmt::format("found more than {} columns", internal::kMaxValuesPerPoint));
    }
  }

  void set_layout(const std::vector<std::string>& names) {
    require_few_columns(names.size());
    layout_ = internal::layout_of(names, columns_, fmt::format("{}: line {}", name_, lines_.line_number()));
    table_ = internal::empty_table(*layout_);
  }

  std::string_view text_;
  std::string_view name_;
  Columns columns_;
  internal::LineReader lines_;
  std::string_view comment_;  ///< The last one before the first point.
  std::optional<TableLayout> layout_;
  std::optional<std::int64_t> num_points_;
  std::vector<double> row_;
  PointTable table_;
};

}  // namespace

PointTable parse_xyz(std::string_view text, std::string_view name, Columns columns) {
  return XyzReader(text, name, columns).read();
}

}  // namespace trysquare
