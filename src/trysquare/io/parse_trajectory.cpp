// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/parse_trajectory.h"

#include "trysquare/io/internal/matrix_rows.h"
#include "trysquare/io/internal/pose_collector.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace trysquare {
namespace {

using internal::fail_at_line;
using internal::LineOf;
using internal::PoseCollector;

constexpr std::array<std::pair<std::string_view, TrajectoryFormat>, 4> kNames = {
    {{"tum", TrajectoryFormat::kTum},
     {"kitti", TrajectoryFormat::kKitti},
     {"euroc", TrajectoryFormat::kEuroc},
     {"matrix", TrajectoryFormat::kMatrices}}};

constexpr int kSecondsToNanoseconds = 9;

/// Calls add(fields, where) for each line that holds values.
template <class Add>
void for_each_row(std::string_view text, std::string_view name, Add&& add) {
  internal::LineReader lines(text);
  std::vector<std::string_view> fields;
  for (std::string_view line; lines.next(line);) {
    internal::split_fields(internal::trimmed(internal::without_comment(line)), fields);
    if (!fields.empty()) add(fields, LineOf{name, lines.line_number()});
  }
}

double number_at(const std::vector<std::string_view>& fields, std::size_t index, const LineOf& where) {
  const std::optional<double> value = internal::parse_double(fields[index]);
  if (!value) {
    fail_at_line(where.file, where.line,
                 fmt::format("value {} is {}, expected a number", index + 1, internal::in_quotes(fields[index])));
  }
  return *value;
}

Eigen::Vector3d position_at(const std::vector<std::string_view>& fields, const LineOf& where, PoseCollector& poses) {
  for (std::size_t i = 1; i <= 3; ++i) poses.note_printed(fields[i]);
  return {number_at(fields, 1, where), number_at(fields, 2, where), number_at(fields, 3, where)};
}

void add_stamp(std::string_view token, int exponent, std::string_view unit, const LineOf& where, PoseCollector& poses) {
  const std::optional<std::int64_t> stamp_ns = internal::parse_scaled_integer(token, exponent);
  if (!stamp_ns) {
    fail_at_line(where.file, where.line,
                 fmt::format("value 1 is {}, expected a time stamp in {}", internal::in_quotes(token), unit));
  }
  poses.add_stamp(*stamp_ns, where);
}

void collect_tum(std::string_view text, std::string_view name, PoseCollector& poses) {
  for_each_row(text, name, [&](const std::vector<std::string_view>& fields, const LineOf& where) {
    if (fields.size() != 8) {
      fail_at_line(name, where.line, fmt::format("found {} values, expected 8: t x y z qx qy qz qw", fields.size()));
    }
    add_stamp(fields[0], kSecondsToNanoseconds, "seconds", where, poses);
    const Eigen::Vector4d q_wxyz(number_at(fields, 7, where), number_at(fields, 4, where), number_at(fields, 5, where),
                                 number_at(fields, 6, where));
    poses.add_quaternion_pose(position_at(fields, where, poses), q_wxyz, where);
  });
}

void collect_euroc(std::string_view text, std::string_view name, PoseCollector& poses) {
  for_each_row(text, name, [&](const std::vector<std::string_view>& fields, const LineOf& where) {
    if (fields.size() < 8) {
      fail_at_line(name, where.line,
                   fmt::format("found {} values, expected 8 or more: t x y z qw qx qy qz", fields.size()));
    }
    add_stamp(fields[0], 0, "nanoseconds", where, poses);
    const Eigen::Vector4d q_wxyz(number_at(fields, 4, where), number_at(fields, 5, where), number_at(fields, 6, where),
                                 number_at(fields, 7, where));
    poses.add_quaternion_pose(position_at(fields, where, poses), q_wxyz, where);
  });
}

void collect_kitti(std::string_view text, std::string_view name, PoseCollector& poses) {
  std::vector<double> rows(12);
  for_each_row(text, name, [&](const std::vector<std::string_view>& fields, const LineOf& where) {
    if (fields.size() != rows.size()) {
      fail_at_line(name, where.line,
                   fmt::format("found {} values, expected 12, a 3×4 matrix row by row", fields.size()));
    }
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = number_at(fields, i, where);
    for (const std::size_t i : {3U, 7U, 11U}) poses.note_printed(fields[i]);
    poses.add_matrix_pose(rows, where);
  });
}

}  // namespace

std::string_view name_of(TrajectoryFormat format) {
  for (const auto& [name, named] : kNames) {
    if (named == format) return name;
  }
  return "";
}

std::optional<TrajectoryFormat> trajectory_format_named(std::string_view name) {
  for (const auto& [known, format] : kNames) {
    if (known == name) return format;
  }
  return std::nullopt;
}

TrajectoryFile parse_trajectory(std::string_view text, std::string_view name, TrajectoryFormat format) {
  PoseCollector poses(format);
  switch (format) {
    case TrajectoryFormat::kTum:
      collect_tum(text, name, poses);
      break;
    case TrajectoryFormat::kKitti:
      collect_kitti(text, name, poses);
      break;
    case TrajectoryFormat::kEuroc:
      collect_euroc(text, name, poses);
      break;
    case TrajectoryFormat::kMatrices:
      internal::collect_matrices(text, name, poses);
      break;
  }
  return poses.finish(name);
}

Trajectory parse_tum(std::string_view text, std::string_view name) {
  return parse_trajectory(text, name, TrajectoryFormat::kTum).trajectory;
}

Trajectory parse_kitti(std::string_view text, std::string_view name) {
  return parse_trajectory(text, name, TrajectoryFormat::kKitti).trajectory;
}

Trajectory parse_euroc(std::string_view text, std::string_view name) {
  return parse_trajectory(text, name, TrajectoryFormat::kEuroc).trajectory;
}

Trajectory parse_matrices(std::string_view text, std::string_view name) {
  return parse_trajectory(text, name, TrajectoryFormat::kMatrices).trajectory;
}

}  // namespace trysquare
