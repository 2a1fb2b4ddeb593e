// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/pcd_header.h"

#include "trysquare/core/error.h"
#include "trysquare/io/internal/table_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>

namespace trysquare::internal {
namespace {

struct Entry {
  std::size_t line = 0;
  std::vector<std::string_view> values;
};

using Entries = std::map<std::string_view, Entry>;

constexpr std::array<std::string_view, 11> kKeys = {"VERSION", "FIELDS", "COLUMNS", "SIZE", "TYPE",     "COUNT",
                                                    "WIDTH",   "HEIGHT", "POINTS",  "DATA", "VIEWPOINT"};

/// White space only: a PCD header knows no commas.
std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::string_view rest = trimmed(line); !rest.empty(); rest = trimmed(rest)) {
    const std::size_t end = std::min(rest.find_first_of(" \t\v\f\r"), rest.size());
    words.push_back(rest.substr(0, end));
    rest.remove_prefix(end);
    if (words.size() > kMaxValuesPerPoint) break;
  }
  return words;
}

Entries read_entries(LineReader& lines, std::string_view name) {
  Entries entries;
  std::size_t begin = lines.offset();
  for (std::string_view line; lines.next(line); begin = lines.offset()) {
    if (const std::size_t nul = line.find('\0'); nul != std::string_view::npos) {
      fail_at_byte(name, begin + nul, "found a NUL byte, expected the text of a PCD header");
    }
    if (line.starts_with('#')) continue;
    std::vector<std::string_view> words = words_of(line);
    if (words.empty()) continue;
    const std::string_view key = words.front();
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      fail_at_line(name, lines.line_number(),
                   fmt::format("found {}, expected a PCD header entry (VERSION FIELDS SIZE TYPE COUNT WIDTH HEIGHT "
                               "VIEWPOINT POINTS DATA)",
                               in_quotes(key)));
    }
    if (words.size() > kMaxValuesPerPoint) {
      fail_at_line(name, lines.line_number(), fmt::format("{} has more than {} values", key, kMaxValuesPerPoint));
    }
    if (entries.contains(key)) fail_at_line(name, lines.line_number(), fmt::format("{} is there twice", key));
    words.erase(words.begin());
    entries[key] = {lines.line_number(), std::move(words)};
    if (key == "DATA") return entries;
  }
  fail_at_byte(name, lines.offset(), "the file ends within the header, expected a DATA line");
}

const Entry& require_entry(const Entries& entries, std::string_view key, std::string_view name, std::size_t data_line) {
  const auto found = entries.find(key);
  if (found == entries.end()) fail_at_line(name, data_line, fmt::format("the header ends here without {}", key));
  return found->second;
}

/// A number >= 0 that stands alone behind its key.
std::uint64_t count_of(const Entry& entry, std::string_view key, std::string_view name) {
  const std::optional<std::int64_t> value = entry.values.size() == 1 ? parse_integer(entry.values[0]) : std::nullopt;
  if (!value || *value < 0) {
    fail_at_line(name, entry.line,
                 fmt::format("{} is {}, expected one whole number that is not negative", key,
                             entry.values.empty() ? "empty" : in_quotes(entry.values[0])));
  }
  return static_cast<std::uint64_t>(*value);
}

std::optional<ScalarType> scalar_type(std::string_view type, std::int64_t size) {
  using enum ScalarType;
  if (type == "F") return size == 4 ? std::optional(kFloat32) : size == 8 ? std::optional(kFloat64) : std::nullopt;
  if (type != "I" && type != "U") return std::nullopt;
  const bool is_signed = type == "I";
  switch (size) {
    case 1:
      return is_signed ? kInt8 : kUint8;
    case 2:
      return is_signed ? kInt16 : kUint16;
    case 4:
      return is_signed ? kInt32 : kUint32;
    case 8:
      return is_signed ? kInt64 : kUint64;
    default:
      return std::nullopt;
  }
}

void require_as_many(const Entry& entry, std::string_view key, const Entry& fields, std::string_view name) {
  if (entry.values.size() != fields.values.size()) {
    fail_at_line(name, entry.line,
                 fmt::format("{} has {} values, expected {}, one for each of FIELDS", key, entry.values.size(),
                             fields.values.size()));
  }
}

std::vector<PcdField> fields_of(const Entries& entries, std::string_view name, std::size_t data_line) {
  const Entry& names = require_entry(entries, entries.contains("COLUMNS") ? "COLUMNS" : "FIELDS", name, data_line);
  const Entry& sizes = require_entry(entries, "SIZE", name, data_line);
  const Entry& types = require_entry(entries, "TYPE", name, data_line);
  const auto counts = entries.find("COUNT");
  require_as_many(sizes, "SIZE", names, name);
  require_as_many(types, "TYPE", names, name);
  if (counts != entries.end()) require_as_many(counts->second, "COUNT", names, name);
  std::vector<PcdField> fields;
  std::size_t num_values = 0;
  for (std::size_t i = 0; i < names.values.size(); ++i) {
    const std::optional<std::int64_t> size = parse_integer(sizes.values[i]);
    const std::optional<ScalarType> type = scalar_type(types.values[i], size.value_or(0));
    if (!type) {
      fail_at_line(name, types.line,
                   fmt::format("field {} has TYPE {} and SIZE {}, expected F of 4 or 8 bytes, I or U of 1, 2, 4 or 8",
                               in_quotes(names.values[i]), in_quotes(types.values[i]), in_quotes(sizes.values[i])));
    }
    const std::optional<std::int64_t> count = counts == entries.end() ? 1 : parse_integer(counts->second.values[i]);
    if (!count || *count < 1 || *count > static_cast<std::int64_t>(kMaxValuesPerPoint - num_values)) {
      fail_at_line(name, counts->second.line,
                   fmt::format("field {} has COUNT {}, expected 1 or more, at most {} for all fields together",
                               in_quotes(names.values[i]), in_quotes(counts->second.values[i]), kMaxValuesPerPoint));
    }
    num_values += static_cast<std::size_t>(*count);
    fields.push_back({std::string(names.values[i]), *type, static_cast<std::size_t>(*count)});
  }
  return fields;
}

std::uint64_t num_points_of(const Entries& entries, std::string_view name, std::size_t data_line) {
  const auto points = entries.find("POINTS");
  const auto height_entry = entries.find("HEIGHT");
  if (points != entries.end() && !entries.contains("WIDTH")) return count_of(points->second, "POINTS", name);
  const Entry& width_entry = require_entry(entries, "WIDTH", name, data_line);
  const std::uint64_t width = count_of(width_entry, "WIDTH", name);
  const std::uint64_t height = height_entry == entries.end() ? 1 : count_of(height_entry->second, "HEIGHT", name);
  if (height != 0 && width > std::numeric_limits<std::uint64_t>::max() / height) {
    fail_at_line(name, width_entry.line, fmt::format("WIDTH {} times HEIGHT {} overflows", width, height));
  }
  if (points == entries.end()) return width * height;
  const std::uint64_t num_points = count_of(points->second, "POINTS", name);
  if (num_points != width * height) {
    fail_at_line(name, points->second.line,
                 fmt::format("POINTS is {}, expected WIDTH times HEIGHT = {}", num_points, width * height));
  }
  return num_points;
}

PcdData data_of(const Entry& entry, std::string_view name) {
  const std::string_view value = entry.values.size() == 1 ? entry.values[0] : std::string_view();
  if (value == "ascii") return PcdData::kAscii;
  if (value == "binary") return PcdData::kBinary;
  if (value == "binary_compressed") return PcdData::kBinaryCompressed;
  fail_at_line(name, entry.line,
               fmt::format("DATA is {}, expected ascii, binary or binary_compressed", in_quotes(value)));
}

}  // namespace

PcdHeader parse_pcd_header(LineReader& lines, std::string_view name) {
  const Entries entries = read_entries(lines, name);
  const Entry& data = entries.at("DATA");
  PcdHeader header;
  header.data = data_of(data, name);
  header.fields = fields_of(entries, name, data.line);
  header.num_points = num_points_of(entries, name, data.line);
  header.fields_line = entries.contains("COLUMNS") ? entries.at("COLUMNS").line : entries.at("FIELDS").line;
  return header;
}

}  // namespace trysquare::internal
