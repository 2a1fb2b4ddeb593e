// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/dataset_rows.h"

#include "trysquare/io/internal/pose_rows.h"
#include "trysquare/io/internal/text.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace trysquare::internal {
namespace {

using Fields = std::vector<std::string_view>;

constexpr int kSecondsToNanoseconds = 9;
constexpr std::string_view kG2oVertex = "VERTEX_SE3:QUAT";

/// Values `first` to `first + 3` as qx qy qz qw, given back as w x y z.
Eigen::Vector4d quaternion_at(const Fields& fields, std::size_t first, const LineOf& where) {
  return {number_at(fields, first + 3, where), number_at(fields, first, where), number_at(fields, first + 1, where),
          number_at(fields, first + 2, where)};
}

/// Rz(yaw)·Ry(pitch)·Rx(roll), row by row, with a position.
std::array<double, 12> rows_of(const Eigen::Vector3d& position, double roll, double pitch, double yaw) {
  const Eigen::Matrix3d r =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  return {r(0, 0), r(0, 1),      r(0, 2), position.x(), r(1, 0), r(1, 1),
          r(1, 2), position.y(), r(2, 0), r(2, 1),      r(2, 2), position.z()};
}

/// A Newer College time: whole seconds, and nanoseconds below a second.
void add_two_part_stamp(const Fields& fields, const LineOf& where, PoseCollector& poses) {
  constexpr std::int64_t kLongest_s = 9'000'000'000;
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  const std::optional<std::int64_t> seconds = parse_integer(fields[0]);
  const std::optional<std::int64_t> nanoseconds = parse_integer(fields[1]);
  if (!seconds || std::abs(*seconds) > kLongest_s) {
    fail_at(where, fmt::format("value 1 is {}, expected whole seconds", in_quotes(fields[0])));
  }
  if (!nanoseconds || *nanoseconds < 0 || *nanoseconds >= kNanosecondsPerSecond) {
    fail_at(where, fmt::format("value 2 is {}, expected nanoseconds below a second", in_quotes(fields[1])));
  }
  poses.add_stamp(*seconds * kNanosecondsPerSecond + *nanoseconds, where);
}

}  // namespace

void collect_nclt(std::string_view text, std::string_view name, PoseCollector& poses) {
  for_each_row(text, name, [&](const Fields& fields, const LineOf& where) {
    constexpr int kMicrosecondsToNanoseconds = 3;
    require_count(fields, 7, "7: utime x y z roll pitch yaw", where);
    std::array<double, 7> values{};
    for (std::size_t i = 1; i < values.size(); ++i) values[i] = number_at(fields, i, where);
    if (std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); })) return;
    add_stamp(fields, 0, kMicrosecondsToNanoseconds, "microseconds", where, poses);
    poses.add_matrix_pose(rows_of(position_at(fields, 1, where, poses), values[4], values[5], values[6]), where);
  });
}

void collect_mulran(std::string_view text, std::string_view name, PoseCollector& poses) {
  std::array<double, 12> rows{};
  for_each_row(text, name, [&](const Fields& fields, const LineOf& where) {
    require_count(fields, 13, "13: a time in nanoseconds and a 3×4 matrix row by row", where);
    add_stamp(fields, 0, 0, "nanoseconds", where, poses);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = number_at(fields, i + 1, where);
    for (const std::size_t i : {4U, 8U, 12U}) poses.note_printed(fields[i]);
    poses.add_matrix_pose(rows, where);
  });
}

void collect_newer_college(std::string_view text, std::string_view name, PoseCollector& poses) {
  for_each_row(text, name, [&](const Fields& fields, const LineOf& where) {
    require_count(fields, 9, "9: sec nsec x y z qx qy qz qw", where);
    add_two_part_stamp(fields, where, poses);
    const Eigen::Vector3d position = position_at(fields, 2, where, poses);
    poses.add_quaternion_pose(position, quaternion_at(fields, 5, where), where);
  });
}

void collect_g2o(std::string_view text, std::string_view name, PoseCollector& poses) {
  for_each_row(text, name, [&](const Fields& fields, const LineOf& where) {
    if (fields[0] != kG2oVertex) return;
    require_count(fields, 9, "9: VERTEX_SE3:QUAT id x y z qx qy qz qw", where);
    if (!parse_integer(fields[1])) {
      fail_at(where, fmt::format("value 2 is {}, expected the number of the vertex", in_quotes(fields[1])));
    }
    const Eigen::Vector3d position = position_at(fields, 2, where, poses);
    poses.add_quaternion_pose(position, quaternion_at(fields, 5, where), where);
  });
}

void collect_balm(std::string_view text, std::string_view name, PoseCollector& poses) {
  std::array<double, 16> rows{};
  std::size_t row = 0;
  LineOf last{name, 1};
  for_each_row(text, name, [&](const Fields& fields, const LineOf& where) {
    require_count(fields, 4, "4: one row of a 4×4 matrix", where);
    for (std::size_t i = 0; i < 4; ++i) rows[4 * row + i] = number_at(fields, i, where);
    if (row < 3) poses.note_printed(fields[3]);
    last = where;
    if (++row < 4) return;
    row = 0;
    add_stamp(fields, 3, kSecondsToNanoseconds, "seconds", where, poses);
    rows[15] = 1;
    poses.add_matrix_pose(rows, where);
  });
  if (row != 0) fail_at(last, fmt::format("the last matrix has {} rows, expected 4", row));
}

}  // namespace trysquare::internal
