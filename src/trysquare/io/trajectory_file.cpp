// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/trajectory_file.h"

#include "trysquare/core/error.h"
#include "trysquare/io/file.h"
#include "trysquare/io/internal/carla_rows.h"
#include "trysquare/io/internal/find_files.h"
#include "trysquare/io/internal/matrix_rows.h"
#include "trysquare/io/internal/pose_collector.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

namespace trysquare {

namespace fs = std::filesystem;

namespace {

bool is_integer_of_digits(std::string_view token, std::size_t fewest, std::size_t most) {
  const bool digits = token.find_first_not_of("0123456789") == std::string_view::npos;
  return digits && token.size() >= fewest && token.size() <= most;
}

bool is_unit_vector(const std::vector<std::string_view>& fields, std::size_t first, std::size_t count) {
  double squared_norm = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    const double value = internal::parse_double(fields[i]).value_or(9);
    squared_norm += value * value;
  }
  return squared_norm > 0.96 && squared_norm < 1.04;
}

/// Seconds and nanoseconds of our time, each whole, and a unit quaternion at the end: no other format has all three.
bool is_two_part_time(const std::vector<std::string_view>& fields) {
  if (!is_integer_of_digits(fields[0], 9, 10) || !is_integer_of_digits(fields[1], 1, 9)) return false;
  return is_unit_vector(fields, 5, 4);
}

/// Matrices whose fourth row ends with a time, not with 1.
bool is_balm(std::string_view text, const fs::path& path) {
  if (internal::lower_case(path.filename().string()) == "alidarpose.csv") return true;
  internal::LineReader lines(text);
  std::vector<std::string_view> fields;
  std::size_t num_rows = 0;
  for (std::string_view line; num_rows < 4 && lines.next(line);) {
    internal::split_fields(internal::trimmed(internal::without_comment(line)), fields);
    if (fields.empty()) continue;
    if (fields.size() != 4) return false;
    ++num_rows;
  }
  const auto is = [&](std::size_t i, double value) { return internal::parse_double(fields[i]) == value; };
  return num_rows == 4 && is(0, 0) && is(1, 0) && is(2, 0) && !is(3, 1) && internal::parse_double(fields[3]);
}

/// By the values of the first line that has any; `path` only decides where they do not.
std::optional<TrajectoryFormat> format_of_fields(const std::vector<std::string_view>& fields, const fs::path& path) {
  if (fields.size() == 9 && is_two_part_time(fields)) return TrajectoryFormat::kNewerCollege;
  const bool nanoseconds = is_integer_of_digits(fields[0], 16, 19);
  if (fields.size() == 13 && nanoseconds && is_unit_vector(fields, 1, 3)) return TrajectoryFormat::kMulran;
  if (fields.size() == 7 && is_integer_of_digits(fields[0], 15, 16)) return TrajectoryFormat::kNclt;
  if (fields.size() >= 8 && nanoseconds) return TrajectoryFormat::kEuroc;
  const bool csv = internal::lower_case(path.extension().string()) == ".csv";
  switch (fields.size()) {
    case 4:
    case 16:
      return TrajectoryFormat::kMatrices;
    case 8:
      if (csv && is_integer_of_digits(fields[0], 1, 19)) return std::nullopt;  // seconds, or a simulation's nanoseconds
      return TrajectoryFormat::kTum;
    case 12:
      return TrajectoryFormat::kKitti;
    default:
      break;
  }
  const bool simulated = csv && fields.size() > 8 && is_integer_of_digits(fields[0], 1, 19);
  return simulated ? std::optional(TrajectoryFormat::kEuroc) : std::nullopt;
}

bool is_g2o(std::string_view first_field) {
  return first_field.starts_with("VERTEX_") || first_field.starts_with("EDGE_") || first_field == "FIX" ||
         first_field.starts_with("PARAMS_");
}

TrajectoryFormat detect_format(std::string_view text, const fs::path& path) {
  if (internal::looks_like_carla(text)) return TrajectoryFormat::kCarla;
  internal::LineReader lines(text);
  std::vector<std::string_view> fields;
  for (std::string_view line; lines.next(line);) {
    internal::split_fields(internal::trimmed(internal::without_comment(line)), fields);
    if (fields.empty()) continue;
    if (is_g2o(fields[0])) return TrajectoryFormat::kG2o;
    if (fields.size() == 4 && is_balm(text, path)) return TrajectoryFormat::kBalm;
    if (const std::optional<TrajectoryFormat> format = format_of_fields(fields, path)) return *format;
    internal::fail_at_line(
        path.string(), lines.line_number(),
        fmt::format("found {} values, beginning with {}, from which the format cannot be told; expected 8 "
                    "(tum: t x y z qx qy qz qw), 12 (kitti), 8 or more beginning with nanoseconds (euroc), 4 or "
                    "16 (matrix), 7 beginning with microseconds (nclt), 13 beginning with nanoseconds (mulran), 9 "
                    "beginning with sec nsec (newer-college), VERTEX_SE3:QUAT (g2o); name the format with "
                    "--poses-format",
                    fields.size(), internal::in_quotes(fields[0])));
  }
  throw IoError(fmt::format("{}: line 1: found no values, expected poses", path.string()));
}

TrajectoryFile read_matrix_files(const std::vector<fs::path>& paths, std::string_view spec) {
  internal::PoseCollector poses(TrajectoryFormat::kMatrices);
  for (const fs::path& path : paths) internal::collect_one_matrix(read_file(path), path.string(), poses);
  return poses.finish(spec);
}

std::vector<fs::path> matrix_files_in(std::string_view folder) {
  std::vector<fs::path> paths = internal::files_in(folder);
  std::erase_if(paths, [](const fs::path& path) { return internal::lower_case(path.extension().string()) != ".txt"; });
  if (paths.empty())
    throw IoError(fmt::format("{}: the directory holds no .txt files, expected one matrix each", folder));
  return paths;
}

}  // namespace

TrajectoryFile read_trajectory(std::string_view spec, std::optional<TrajectoryFormat> format) {
  std::error_code ignored;
  const bool directory = fs::is_directory(spec, ignored);
  const std::vector<fs::path> paths = directory ? matrix_files_in(spec) : internal::files_named(spec);
  if (directory || paths.size() > 1) {
    if (format && *format != TrajectoryFormat::kMatrices) {
      throw IoError(fmt::format("{}: it stands for {} files, expected one file of the format {}", spec, paths.size(),
                                name_of(*format)));
    }
    return read_matrix_files(paths, spec);
  }
  const std::string text = read_file(paths.front());
  return parse_trajectory(text, paths.front().string(), format ? *format : detect_format(text, paths.front()));
}

}  // namespace trysquare
