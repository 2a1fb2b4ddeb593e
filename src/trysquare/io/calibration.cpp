// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/calibration.h"

#include "trysquare/core/error.h"
#include "trysquare/io/file.h"
#include "trysquare/io/internal/pose_collector.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace trysquare {
namespace {

using internal::fail_at_line;

constexpr std::array<std::string_view, 3> kKeys = {"Tr", "Tr_velo_to_cam", "Tr_velo_cam"};

std::string_view key_of(std::string_view line) {
  const std::string_view content = internal::trimmed(line);
  return content.substr(0, content.find_first_of(": \t"));
}

std::string_view values_of(std::string_view line) {
  std::string_view content = internal::trimmed(line);
  content = internal::trimmed(content.substr(key_of(line).size()));
  if (content.starts_with(':')) content.remove_prefix(1);
  return internal::trimmed(content);
}

/// All numbers of a text, and the line of the first one.
struct Numbers {
  std::vector<double> values;
  std::size_t first_line = 1;
};

Numbers all_numbers(std::string_view text, std::string_view name) {
  constexpr std::size_t kMaxNumbers = 16;
  Numbers numbers;
  std::vector<double> row;
  internal::LineReader lines(text);
  for (std::string_view line; lines.next(line);) {
    internal::read_numbers(name, lines.line_number(), internal::trimmed(internal::without_comment(line)), row);
    if (row.empty()) continue;
    if (numbers.values.empty()) numbers.first_line = lines.line_number();
    numbers.values.insert(numbers.values.end(), row.begin(), row.end());
    if (numbers.values.size() > kMaxNumbers) break;
  }
  if (numbers.values.size() != 12 && numbers.values.size() != 16) {
    fail_at_line(
        name, numbers.first_line,
        fmt::format("found {} numbers, expected the 12 of a 3×4 or the 16 of a 4×4 matrix",
                    numbers.values.size() > kMaxNumbers ? "more than 16" : std::to_string(numbers.values.size())));
  }
  return numbers;
}

Pose parse_extrinsic(std::string_view text, std::string_view name) {
  const Numbers numbers = all_numbers(text, name);
  return internal::pose_of_matrix(numbers.values, {name, numbers.first_line});
}

}  // namespace

Pose parse_kitti_calibration(std::string_view text, std::string_view name) {
  std::optional<Pose> camera_from_velodyne;
  std::string found;
  std::vector<double> numbers;
  internal::LineReader lines(text);
  for (std::string_view line; lines.next(line);) {
    const std::string_view key = key_of(line);
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      if (!key.empty() && found.size() < 200) found.append(" ").append(internal::in_quotes(key));
      continue;
    }
    if (camera_from_velodyne) fail_at_line(name, lines.line_number(), fmt::format("found {} after another Tr", key));
    internal::read_numbers(name, lines.line_number(), values_of(line), numbers);
    if (numbers.size() != 12) {
      fail_at_line(name, lines.line_number(),
                   fmt::format("found {} numbers behind {}, expected 12", numbers.size(), key));
    }
    camera_from_velodyne = internal::pose_of_matrix(numbers, {name, lines.line_number()});
  }
  if (!camera_from_velodyne) {
    fail_at_line(name, std::max<std::size_t>(lines.line_number(), 1),
                 fmt::format("the file ends without a line Tr: (or Tr_velo_to_cam:); found{}",
                             found.empty() ? " no line" : found));
  }
  return *camera_from_velodyne;
}

Pose read_kitti_calibration(const std::filesystem::path& path) {
  return parse_kitti_calibration(read_file(path), path.string());
}

Pose read_extrinsic(std::string_view file_or_numbers) {
  std::error_code not_a_path;
  if (std::filesystem::exists(file_or_numbers, not_a_path)) {
    return parse_extrinsic(read_file(file_or_numbers), std::string(file_or_numbers));
  }
  if (file_or_numbers.find_first_of("0123456789") == std::string_view::npos ||
      !internal::parse_double(file_or_numbers.substr(0, file_or_numbers.find_first_of(" ,;\t\r\n")))) {
    throw IoError(fmt::format("{}: no such file, and not 12 or 16 numbers either", file_or_numbers));
  }
  return parse_extrinsic(file_or_numbers, "extrinsic");
}

}  // namespace trysquare
