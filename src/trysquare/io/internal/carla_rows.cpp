// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/carla_rows.h"

#include "trysquare/core/error.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace trysquare::internal {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 3> kLocation = {"x", "y", "z"};
constexpr std::array<std::string_view, 3> kRotation = {"roll", "pitch", "yaw"};
constexpr std::string_view kFirstEntry = "m00";

/// Rows of world_from_actor, 3×4, as CARLA's Transform::get_matrix: left-handed, so that a positive yaw turns x to y
/// (right), a positive pitch lifts the nose, and a positive roll lowers the right side.
std::array<double, 12> matrix_of(const std::array<double, 3>& location_m, const std::array<double, 3>& rotation_deg) {
  constexpr double kRadiansPerDegree = std::numbers::pi / 180;
  const double sr = std::sin(rotation_deg[0] * kRadiansPerDegree);
  const double cr = std::cos(rotation_deg[0] * kRadiansPerDegree);
  const double sp = std::sin(rotation_deg[1] * kRadiansPerDegree);
  const double cp = std::cos(rotation_deg[1] * kRadiansPerDegree);
  const double sy = std::sin(rotation_deg[2] * kRadiansPerDegree);
  const double cy = std::cos(rotation_deg[2] * kRadiansPerDegree);
  return {cp * cy,
          cy * sp * sr - sy * cr,
          -cy * sp * cr - sy * sr,
          location_m[0],  //
          cp * sy,
          sy * sp * sr + cy * cr,
          -sy * sp * cr + cy * sr,
          location_m[1],  //
          sp,
          -cp * sr,
          cp * cr,
          location_m[2]};
}

std::string_view first_line_with_text(std::string_view text) {
  LineReader lines(text);
  for (std::string_view line; lines.next(line);) {
    if (const std::string_view content = trimmed(line); !content.empty()) return content;
  }
  return {};
}

bool is_json(std::string_view text) {
  const std::string_view line = first_line_with_text(text);
  return line.starts_with('[') || line.starts_with('{');
}

// ---- CSV ------------------------------------------------------------------------------------------------------------

/// Where each column of the header stands. The header may be a comment, as numpy writes it.
std::map<std::string, std::size_t> columns_of(std::string_view header) {
  if (header.starts_with('#')) header.remove_prefix(1);
  std::vector<std::string_view> fields;
  split_fields(trimmed(header), fields);
  std::map<std::string, std::size_t> columns;
  for (std::size_t i = 0; i < fields.size(); ++i) columns.emplace(lower_case(fields[i]), i);
  return columns;
}

/// The rows of a CSV by the names of their columns.
class CsvRows {
 public:
  CsvRows(std::string_view header, const LineOf& where) : columns_(columns_of(header)) {
    for (const auto& [column, index] : columns_) num_columns_ = std::max(num_columns_, index + 1);
    has_matrices_ = columns_.contains(std::string(kFirstEntry));
    has_stamps_ = columns_.contains("timestamp");
    require("frame", where);
    if (has_matrices_) {
      for (std::size_t i = 0; i < 16; ++i) require(fmt::format("m{}{}", i / 4, i % 4), where);
    } else {
      for (const std::string_view column : kLocation) require(column, where);
      for (const std::string_view column : kRotation) require(column, where);
    }
  }

  void add(const std::vector<std::string_view>& fields, const LineOf& where, PoseCollector& poses) const {
    if (fields.size() != num_columns_) {
      fail_at(where, fmt::format("found {} values, expected {}, one for each column of the header", fields.size(),
                                 num_columns_));
    }
    const std::string_view frame = fields[columns_.at("frame")];
    const std::optional<std::int64_t> number = parse_integer(frame);
    if (!number) fail_at(where, fmt::format("frame is {}, expected a whole number", in_quotes(frame)));
    poses.add_frame(*number, where);
    if (has_stamps_) add_stamp(fields[columns_.at("timestamp")], where, poses);
    if (has_matrices_) {
      add_matrix(fields, where, poses);
    } else {
      poses.add_matrix_pose(matrix_of(three(kLocation, fields, where), three(kRotation, fields, where)), where);
      for (const std::string_view column : kLocation) poses.note_printed(fields[columns_.at(std::string(column))]);
    }
  }

 private:
  void require(std::string_view column, const LineOf& where) const {
    if (columns_.contains(std::string(column))) return;
    fail_at(where, fmt::format("the header has no column {}, expected frame, x, y, z, roll, pitch, yaw or frame, m00 "
                               "to m33",
                               column));
  }

  double number(const std::string& column, const std::vector<std::string_view>& fields, const LineOf& where) const {
    const std::string_view token = fields[columns_.at(column)];
    const std::optional<double> value = parse_double(token);
    if (!value) fail_at(where, fmt::format("{} is {}, expected a number", column, in_quotes(token)));
    return *value;
  }

  std::array<double, 3> three(const std::array<std::string_view, 3>& names, const std::vector<std::string_view>& fields,
                              const LineOf& where) const {
    return {number(std::string(names[0]), fields, where), number(std::string(names[1]), fields, where),
            number(std::string(names[2]), fields, where)};
  }

  static void add_stamp(std::string_view token, const LineOf& where, PoseCollector& poses) {
    const std::optional<std::int64_t> stamp_ns = parse_scaled_integer(token, 9);
    if (!stamp_ns) fail_at(where, fmt::format("timestamp is {}, expected seconds", in_quotes(token)));
    poses.add_stamp(*stamp_ns, where);
  }

  void add_matrix(const std::vector<std::string_view>& fields, const LineOf& where, PoseCollector& poses) const {
    std::array<double, 16> rows{};
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = number(fmt::format("m{}{}", i / 4, i % 4), fields, where);
    poses.add_matrix_pose(rows, where);
  }

  std::map<std::string, std::size_t> columns_;
  std::size_t num_columns_ = 0;
  bool has_matrices_ = false;
  bool has_stamps_ = false;
};

void collect_csv(std::string_view text, std::string_view name, PoseCollector& poses) {
  std::optional<CsvRows> rows;
  LineReader lines(text);
  std::vector<std::string_view> fields;
  for (std::string_view line; lines.next(line);) {
    const LineOf where{name, lines.line_number()};
    if (!rows) {
      if (!trimmed(line).empty()) rows.emplace(trimmed(line), where);
      continue;
    }
    split_fields(trimmed(without_comment(line)), fields);
    if (!fields.empty()) rows->add(fields, where, poses);
  }
}

// ---- JSON -----------------------------------------------------------------------------------------------------------

std::optional<double> number_of(const Json& item, std::string_view key) {
  const auto found = item.find(key);
  if (found == item.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

/// Three numbers of an object by their keys.
std::array<double, 3> three(const Json& item, const std::array<std::string_view, 3>& keys, const LineOf& where) {
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::optional<double> value = item.is_object() ? number_of(item, keys[i]) : std::nullopt;
    if (!value) fail_at(where, fmt::format("found no number {}, expected x, y, z and roll, pitch, yaw", keys[i]));
    values[i] = *value;
  }
  return values;
}

/// 16 numbers, or four rows of four.
std::array<double, 16> matrix_of(const Json& matrix, const LineOf& where) {
  std::vector<double> values;
  const auto append = [&](const Json& value) {
    if (value.is_number()) values.push_back(value.get<double>());
  };
  for (const Json& row : matrix) {
    if (!row.is_array()) append(row);
    if (row.is_array()) std::for_each(row.begin(), row.end(), append);
  }
  if (!matrix.is_array() || values.size() != 16) {
    fail_at(where, fmt::format("matrix has {} numbers, expected 16, or four rows of four", values.size()));
  }
  std::array<double, 16> rows{};
  std::copy(values.begin(), values.end(), rows.begin());
  return rows;
}

const Json& member_or(const Json& item, const char* key) {
  const auto found = item.find(key);
  return found == item.end() ? item : *found;
}

void add_stamp_of(const Json& item, const LineOf& where, PoseCollector& poses) {
  constexpr double kLongest_s = 9e9;  // what 64-bit nanoseconds hold
  if (!item.contains("timestamp")) return;
  const std::optional<double> stamp_s = number_of(item, "timestamp");
  if (!stamp_s || !(std::abs(*stamp_s) < kLongest_s)) fail_at(where, "timestamp is no number of seconds");
  poses.add_stamp(std::llround(*stamp_s * 1e9), where);
}

std::int64_t frame_of(const Json& item, const LineOf& where) {
  const auto found = item.find("frame");
  if (found == item.end() || !found->is_number_integer()) {
    fail_at(where, "found no frame, expected a whole number of that name");
  }
  return found->get<std::int64_t>();
}

void add_item(const Json& item, std::int64_t frame, const LineOf& where, PoseCollector& poses) {
  poses.add_frame(frame, where);
  add_stamp_of(item, where, poses);
  const Json& transform = member_or(item, "transform");
  if (transform.is_object() && transform.contains("matrix")) {
    poses.add_matrix_pose(matrix_of(transform.at("matrix"), where), where);
  } else if (transform.is_array()) {
    poses.add_matrix_pose(matrix_of(transform, where), where);
  } else {
    const std::array<double, 3> location_m = three(member_or(transform, "location"), kLocation, where);
    const std::array<double, 3> rotation_deg = three(member_or(transform, "rotation"), kRotation, where);
    poses.add_matrix_pose(matrix_of(location_m, rotation_deg), where);
  }
}

Json parse_json(std::string_view text, std::string_view name) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    fail_at_byte(name, error.byte > 0 ? error.byte - 1 : 0, "it is no JSON");
  } catch (const Json::exception&) {
    fail_at_byte(name, 0, "it holds a number that is too large");
  }
}

/// {"17": {..}, "18": {..}}: an object keeps no order, so the order is that of the frames.
void collect_items_by_key(const Json& document, std::string_view name, PoseCollector& poses) {
  std::map<std::int64_t, const Json*> items;
  for (const auto& [key, item] : document.items()) {
    const std::optional<std::int64_t> frame = parse_integer(key);
    if (!frame) fail_at_byte(name, 0, fmt::format("found the key {}, expected frame numbers", in_quotes(key)));
    items.emplace(*frame, &item);
  }
  for (const auto& [frame, item] : items)
    add_item(*item, frame, {name, static_cast<std::size_t>(frame), "frame"}, poses);
}

void collect_json(std::string_view text, std::string_view name, PoseCollector& poses) {
  const Json document = parse_json(text, name);
  if (document.is_object()) return collect_items_by_key(document, name, poses);
  std::size_t number = 0;
  for (const Json& item : document) {
    const LineOf where{name, ++number, "item"};
    add_item(item, frame_of(item, where), where, poses);
  }
}

}  // namespace

bool looks_like_carla(std::string_view text) {
  if (is_json(text)) return true;
  const std::map<std::string, std::size_t> columns = columns_of(first_line_with_text(text));
  return columns.contains("frame") && (columns.contains("yaw") || columns.contains(std::string(kFirstEntry)));
}

void collect_carla(std::string_view text, std::string_view name, PoseCollector& poses) {
  if (is_json(text)) {
    collect_json(text, name, poses);
  } else {
    collect_csv(text, name, poses);
  }
}

}  // namespace trysquare::internal
