// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/internal/pose_collector.h"
#include "trysquare/io/internal/text.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace trysquare::internal {

/// Calls add(fields, where) for each line that holds values.
template <class Add>
void for_each_row(std::string_view text, std::string_view name, Add&& add) {
  LineReader lines(text);
  std::vector<std::string_view> fields;
  for (std::string_view line; lines.next(line);) {
    split_fields(trimmed(without_comment(line)), fields);
    if (!fields.empty()) add(fields, LineOf{name, lines.line_number()});
  }
}

/// @throws IoError  if the value is no number; it may be infinite or NaN.
double number_at(const std::vector<std::string_view>& fields, std::size_t index, const LineOf& where);

/// Three values from `first` on, whose printed digits are noted.
Eigen::Vector3d position_at(const std::vector<std::string_view>& fields, std::size_t first, const LineOf& where,
                            PoseCollector& poses);

/// Adds a value · 10^exponent as nanoseconds. @param unit  What it is in, for the message.
void add_stamp(const std::vector<std::string_view>& fields, std::size_t index, int exponent, std::string_view unit,
               const LineOf& where, PoseCollector& poses);

/// @throws IoError  unless there are `count` values. @param what  "8: t x y z qx qy qz qw".
void require_count(const std::vector<std::string_view>& fields, std::size_t count, std::string_view what,
                   const LineOf& where);

}  // namespace trysquare::internal
