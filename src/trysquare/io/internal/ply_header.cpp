// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/ply_header.h"

#include "trysquare/io/internal/table_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace trysquare::internal {
namespace {

std::optional<ScalarType> scalar_named(std::string_view name) {
  using enum ScalarType;
  constexpr std::array<std::pair<std::string_view, ScalarType>, 16> kNames = {{{"char", kInt8},
                                                                               {"int8", kInt8},
                                                                               {"uchar", kUint8},
                                                                               {"uint8", kUint8},
                                                                               {"short", kInt16},
                                                                               {"int16", kInt16},
                                                                               {"ushort", kUint16},
                                                                               {"uint16", kUint16},
                                                                               {"int", kInt32},
                                                                               {"int32", kInt32},
                                                                               {"uint", kUint32},
                                                                               {"uint32", kUint32},
                                                                               {"float", kFloat32},
                                                                               {"float32", kFloat32},
                                                                               {"double", kFloat64},
                                                                               {"float64", kFloat64}}};
  const auto* found =
      std::find_if(kNames.begin(), kNames.end(), [&](const auto& entry) { return entry.first == name; });
  return found == kNames.end() ? std::nullopt : std::optional(found->second);
}

class HeaderReader {
 public:
  HeaderReader(LineReader& lines, std::string_view name) : lines_(lines), name_(name) {}

  PlyHeader read() {
    std::string_view line;
    if (!next_line(line) || trimmed(line) != "ply") fail("found {}, expected ply", line);
    while (next_line(line)) {
      split_words(line);
      if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") continue;
      if (words_[0] == "end_header") return finished();
      read_entry();
    }
    fail_at_byte(name_, lines_.offset(), "the file ends within the header, expected end_header");
  }

 private:
  [[noreturn]] void fail(std::string_view message, std::string_view found) const {
    fail_at_line(name_, std::max<std::size_t>(lines_.line_number(), 1),
                 fmt::format(fmt::runtime(message), in_quotes(found)));
  }

  bool next_line(std::string_view& line) {
    const std::size_t begin = lines_.offset();
    if (!lines_.next(line)) return false;
    if (const std::size_t nul = line.find('\0'); nul != std::string_view::npos) {
      fail_at_byte(name_, begin + nul, "found a NUL byte, expected the text of a PLY header");
    }
    return true;
  }

  void split_words(std::string_view line) {
    constexpr std::size_t kMaxWords =
        6;  // property list uchar int vertex_indices, and one more to see that it is too many
    words_.clear();
    for (std::string_view rest = trimmed(line); !rest.empty() && words_.size() < kMaxWords; rest = trimmed(rest)) {
      const std::size_t end = std::min(rest.find_first_of(" \t\v\f\r"), rest.size());
      words_.push_back(rest.substr(0, end));
      rest.remove_prefix(end);
    }
  }

  void read_entry() {
    if (words_[0] == "format") {
      read_format();
    } else if (words_[0] == "element") {
      read_element();
    } else if (words_[0] == "property") {
      read_property();
    } else {
      fail("found {}, expected format, element, property, comment or end_header", words_[0]);
    }
  }

  void read_format() {
    constexpr std::array<std::pair<std::string_view, PlyFormat>, 3> kFormats = {
        {{"ascii", PlyFormat::kAscii},
         {"binary_little_endian", PlyFormat::kBinaryLittleEndian},
         {"binary_big_endian", PlyFormat::kBinaryBigEndian}}};
    const std::string_view value = words_.size() == 3 ? words_[1] : std::string_view();
    const auto* found =
        std::find_if(kFormats.begin(), kFormats.end(), [&](const auto& entry) { return entry.first == value; });
    if (found == kFormats.end() || words_[2] != "1.0") {
      fail("found the format {}, expected ascii, binary_little_endian or binary_big_endian, and 1.0", value);
    }
    if (has_format_) fail("found a second format, {}", value);
    has_format_ = true;
    header_.format = found->second;
  }

  void read_element() {
    const std::optional<std::int64_t> count = words_.size() == 3 ? parse_integer(words_[2]) : std::nullopt;
    if (!count || *count < 0) {
      fail("found the count {}, expected element NAME and a whole number that is not negative",
           words_.size() > 2 ? words_[2] : "");
    }
    const auto same_name = [&](const PlyElement& element) { return element.name == words_[1]; };
    if (words_[1] == "vertex" && std::any_of(header_.elements.begin(), header_.elements.end(), same_name)) {
      fail("found a second element {}", words_[1]);
    }
    header_.elements.push_back({std::string(words_[1]), static_cast<std::uint64_t>(*count), lines_.line_number(), {}});
  }

  void read_property() {
    if (header_.elements.empty()) fail("found {} before any element", words_[0]);
    PlyProperty property;
    const bool is_list = words_.size() > 1 && words_[1] == "list";
    if (words_.size() != (is_list ? 5U : 3U)) {
      fail("found {} with another number of words, expected property TYPE NAME or property list TYPE TYPE NAME",
           words_[0]);
    }
    if (is_list) {
      property.list_count = scalar_named(words_[2]);
      const bool counts = property.list_count && *property.list_count != ScalarType::kFloat32 &&
                          *property.list_count != ScalarType::kFloat64;
      if (!counts) fail("the number of items has the type {}, expected one of integers", words_[2]);
    }
    const std::string_view type_name = words_[words_.size() - 2];
    const std::optional<ScalarType> type = scalar_named(type_name);
    if (!type) fail("found the type {}, expected char, uchar, short, ushort, int, uint, float or double", type_name);
    property.type = *type;
    property.name = std::string(words_.back());
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    properties.push_back(std::move(property));
    if (properties.size() > kMaxValuesPerPoint) fail("found too many properties at {}", words_.back());
  }

  PlyHeader finished() {
    if (!has_format_) fail("found {}, expected a format line before it", "end_header");
    bool has_vertex = false;
    for (const PlyElement& element : header_.elements) {
      has_vertex = has_vertex || element.name == "vertex";
      if (element.properties.empty()) {
        fail_at_line(name_, element.line, fmt::format("element {} has no properties", in_quotes(element.name)));
      }
    }
    if (!has_vertex) fail("found {}, expected an element vertex before it", "end_header");
    return std::move(header_);
  }

  LineReader& lines_;
  std::string_view name_;
  PlyHeader header_;
  bool has_format_ = false;
  std::vector<std::string_view> words_;
};

}  // namespace

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& property) { return property.list_count.has_value(); });
}

std::size_t PlyElement::smallest_size() const {
  std::size_t size = 0;
  for (const PlyProperty& property : properties) size += size_of(property.list_count.value_or(property.type));
  return size;
}

PlyHeader parse_ply_header(LineReader& lines, std::string_view name) { return HeaderReader(lines, name).read(); }

}  // namespace trysquare::internal
