// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/parse_trajectory.h"

#include "trysquare/io/internal/carla_rows.h"
#include "trysquare/io/internal/dataset_rows.h"
#include "trysquare/io/internal/matrix_rows.h"
#include "trysquare/io/internal/pose_collector.h"
#include "trysquare/io/internal/pose_rows.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace trysquare {
namespace {

using internal::add_stamp;
using internal::fail_at_line;
using internal::for_each_row;
using internal::LineOf;
using internal::number_at;
using internal::PoseCollector;
using internal::position_at;

constexpr std::array<std::pair<std::string_view, TrajectoryFormat>, 10> kNames = {
    {{"tum", TrajectoryFormat::kTum},
     {"kitti", TrajectoryFormat::kKitti},
     {"euroc", TrajectoryFormat::kEuroc},
     {"matrix", TrajectoryFormat::kMatrices},
     {"carla", TrajectoryFormat::kCarla},
     {"nclt", TrajectoryFormat::kNclt},
     {"mulran", TrajectoryFormat::kMulran},
     {"newer-college", TrajectoryFormat::kNewerCollege},
     {"g2o", TrajectoryFormat::kG2o},
     {"balm", TrajectoryFormat::kBalm}}};

constexpr int kSecondsToNanoseconds = 9;

void collect_tum(std::string_view text, std::string_view name, PoseCollector& poses) {
  for_each_row(text, name, [&](const std::vector<std::string_view>& fields, const LineOf& where) {
    if (fields.size() != 8) {
      fail_at_line(name, where.line, fmt::format("found {} values, expected 8: t x y z qx qy qz qw", fields.size()));
    }
    add_stamp(fields, 0, kSecondsToNanoseconds, "seconds", where, poses);
    const Eigen::Vector4d q_wxyz(number_at(fields, 7, where), number_at(fields, 4, where), number_at(fields, 5, where),
                                 number_at(fields, 6, where));
    poses.add_quaternion_pose(position_at(fields, 1, where, poses), q_wxyz, where);
  });
}

void collect_euroc(std::string_view text, std::string_view name, PoseCollector& poses) {
  for_each_row(text, name, [&](const std::vector<std::string_view>& fields, const LineOf& where) {
    if (fields.size() < 8) {
      fail_at_line(name, where.line,
                   fmt::format("found {} values, expected 8 or more: t x y z qw qx qy qz", fields.size()));
    }
    add_stamp(fields, 0, 0, "nanoseconds", where, poses);
    const Eigen::Vector4d q_wxyz(number_at(fields, 4, where), number_at(fields, 5, where), number_at(fields, 6, where),
                                 number_at(fields, 7, where));
    poses.add_quaternion_pose(position_at(fields, 1, where, poses), q_wxyz, where);
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
    case TrajectoryFormat::kCarla:
      internal::collect_carla(text, name, poses);
      break;
    case TrajectoryFormat::kNclt:
      internal::collect_nclt(text, name, poses);
      break;
    case TrajectoryFormat::kMulran:
      internal::collect_mulran(text, name, poses);
      break;
    case TrajectoryFormat::kNewerCollege:
      internal::collect_newer_college(text, name, poses);
      break;
    case TrajectoryFormat::kG2o:
      internal::collect_g2o(text, name, poses);
      break;
    case TrajectoryFormat::kBalm:
      internal::collect_balm(text, name, poses);
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
