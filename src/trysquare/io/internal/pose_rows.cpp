// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/pose_rows.h"

#include <fmt/format.h>

namespace trysquare::internal {

double number_at(const std::vector<std::string_view>& fields, std::size_t index, const LineOf& where) {
  const std::optional<double> value = parse_double(fields[index]);
  if (!value) fail_at(where, fmt::format("value {} is {}, expected a number", index + 1, in_quotes(fields[index])));
  return *value;
}

Eigen::Vector3d position_at(const std::vector<std::string_view>& fields, std::size_t first, const LineOf& where,
                            PoseCollector& poses) {
  for (std::size_t i = first; i < first + 3; ++i) poses.note_printed(fields[i]);
  return {number_at(fields, first, where), number_at(fields, first + 1, where), number_at(fields, first + 2, where)};
}

void add_stamp(const std::vector<std::string_view>& fields, std::size_t index, int exponent, std::string_view unit,
               const LineOf& where, PoseCollector& poses) {
  const std::optional<std::int64_t> stamp_ns = parse_scaled_integer(fields[index], exponent);
  if (!stamp_ns) {
    fail_at(where,
            fmt::format("value {} is {}, expected a time stamp in {}", index + 1, in_quotes(fields[index]), unit));
  }
  poses.add_stamp(*stamp_ns, where);
}

void require_count(const std::vector<std::string_view>& fields, std::size_t count, std::string_view what,
                   const LineOf& where) {
  if (fields.size() != count) fail_at(where, fmt::format("found {} values, expected {}", fields.size(), what));
}

}  // namespace trysquare::internal
