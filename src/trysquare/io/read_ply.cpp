// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_ply.h"

#include "trysquare/io/internal/ply_header.h"
#include "trysquare/io/internal/record_size.h"
#include "trysquare/io/internal/table_layout.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>

#include <cmath>

namespace trysquare {
namespace {

using internal::fail_at_byte;
using internal::fail_at_line;
using internal::in_quotes;
using internal::PlyElement;
using internal::PlyFormat;
using internal::PlyHeader;
using internal::PlyProperty;
using internal::StridedScalars;
using internal::TableLayout;

constexpr std::string_view kPoints = "vertex";

/// The scalar properties; lists have no place in a table, nor in `row` below.
std::vector<std::string> value_names(const PlyElement& vertex) {
  std::vector<std::string> names;
  for (const PlyProperty& property : vertex.properties) {
    if (!property.list_count) names.push_back(property.name);
  }
  return names;
}

/// The body of a binary file, read record by record.
class BinaryBody {
 public:
  BinaryBody(std::string_view bytes, std::size_t at, std::endian order, std::string_view name)
      : bytes_(bytes), at_(at), order_(order), name_(name) {}

  void skip(const PlyElement& element) {
    require_claim(element);
    if (!element.has_lists()) {
      at_ += static_cast<std::size_t>(element.count) * element.smallest_size();
      return;
    }
    std::vector<double> row;
    for (std::uint64_t i = 0; i < element.count; ++i) read_record(element, row);
  }

  PointTable read_points(const PlyElement& vertex, const TableLayout& layout) {
    require_claim(vertex);
    const auto num_points = static_cast<std::size_t>(vertex.count);
    if (!vertex.has_lists()) return read_fixed_records(vertex, num_points, layout);
    PointTable table = internal::empty_table(layout);
    table.points.reserve(num_points);
    std::vector<double> row;
    for (std::size_t i = 0; i < num_points; ++i) {
      read_record(vertex, row);
      internal::append_row(row, layout, table);
    }
    return table;
  }

 private:
  void require_claim(const PlyElement& element) const {
    if (element.count > (bytes_.size() - at_) / element.smallest_size()) {
      fail_at_byte(
          name_, at_,
          fmt::format("the file ends early: {} bytes from here, expected {} of element {} with {} bytes or more",
                      bytes_.size() - at_, element.count, in_quotes(element.name), element.smallest_size()));
    }
  }

  PointTable read_fixed_records(const PlyElement& vertex, std::size_t num_points, const TableLayout& layout) const {
    const std::size_t stride = vertex.smallest_size();
    std::vector<StridedScalars> values;
    std::size_t offset = at_;
    for (const PlyProperty& property : vertex.properties) {
      values.push_back({bytes_.data() + offset, stride, property.type, order_});
      offset += internal::size_of(property.type);
    }
    return internal::gather_table(layout, num_points, [&](std::size_t value) { return values[value]; });
  }

  /// The scalars of one record into `row`; lists are stepped over.
  void read_record(const PlyElement& element, std::vector<double>& row) {
    row.clear();
    for (const PlyProperty& property : element.properties) {
      const double value = read_scalar(property.list_count.value_or(property.type));
      if (property.list_count) {
        skip_list(value, internal::size_of(property.type));
      } else {
        row.push_back(value);
      }
    }
  }

  double read_scalar(internal::ScalarType type) {
    if (internal::size_of(type) > bytes_.size() - at_) {
      fail_at_byte(name_, at_,
                   fmt::format("the file ends within a record: {} bytes, expected {}", bytes_.size() - at_,
                               internal::size_of(type)));
    }
    const double value = internal::load_scalar(bytes_.data() + at_, type, order_);
    at_ += internal::size_of(type);
    return value;
  }

  void skip_list(double num_items, std::size_t item_size) {
    if (num_items < 0 || num_items > static_cast<double>((bytes_.size() - at_) / item_size)) {
      fail_at_byte(
          name_, at_,
          fmt::format("found a list of {} items of {} bytes, expected 0 or more and no more than the {} bytes that "
                      "follow",
                      num_items, item_size, bytes_.size() - at_));
    }
    at_ += static_cast<std::size_t>(num_items) * item_size;
  }

  std::string_view bytes_;
  std::size_t at_;
  std::endian order_;
  std::string_view name_;
};

/// The body of a text file: one record a line.
class AsciiBody {
 public:
  AsciiBody(internal::LineReader& lines, std::string_view bytes, std::string_view name)
      : lines_(lines), bytes_(bytes), name_(name) {}

  void skip(const PlyElement& element) {
    internal::require_text_for(element.count, 1, bytes_, lines_, name_);
    for (std::uint64_t i = 0; i < element.count; ++i) next_record(element);
  }

  PointTable read_points(const PlyElement& vertex, const TableLayout& layout) {
    internal::require_text_for(vertex.count, vertex.properties.size(), bytes_, lines_, name_);
    PointTable table = internal::empty_table(layout);
    table.points.reserve(static_cast<std::size_t>(vertex.count));
    std::vector<double> tokens;
    std::vector<double> row;
    for (std::uint64_t i = 0; i < vertex.count; ++i) {
      const std::string_view line = next_record(vertex);
      internal::read_numbers(name_, lines_.line_number(), line, tokens);
      select_scalars(vertex, tokens, row);
      internal::append_row(row, layout, table);
    }
    return table;
  }

 private:
  /// The next line that is not blank.
  std::string_view next_record(const PlyElement& element) {
    for (std::string_view line; lines_.next(line);) {
      if (!internal::trimmed(line).empty()) return line;
    }
    fail_at_byte(name_, bytes_.size(),
                 fmt::format("the file ends early, expected {} of element {}", element.count, in_quotes(element.name)));
  }

  void select_scalars(const PlyElement& element, const std::vector<double>& tokens, std::vector<double>& row) const {
    row.clear();
    std::size_t at = 0;
    for (const PlyProperty& property : element.properties) {
      if (at >= tokens.size()) fail_count(tokens.size(), "more");
      const double value = tokens[at++];
      if (!property.list_count) {
        row.push_back(value);
        continue;
      }
      if (!(value >= 0) || value != std::floor(value) || value > static_cast<double>(tokens.size() - at)) {
        fail_at_line(
            name_, lines_.line_number(),
            fmt::format("found a list of {} items, expected 0 or more and no more than the {} values that follow",
                        value, tokens.size() - at));
      }
      at += static_cast<std::size_t>(value);
    }
    if (at != tokens.size()) fail_count(tokens.size(), fmt::format("{}", at));
  }

  [[noreturn]] void fail_count(std::size_t found, std::string_view expected) const {
    fail_at_line(name_, lines_.line_number(), fmt::format("found {} values, expected {}", found, expected));
  }

  internal::LineReader& lines_;
  std::string_view bytes_;
  std::string_view name_;
};

template <class Body>
PointTable read_vertices(Body body, const PlyHeader& header, const TableLayout& layout) {
  auto element = header.elements.begin();
  for (; element->name != kPoints; ++element) body.skip(*element);
  return body.read_points(*element, layout);
}

const PlyElement& vertex_of(const PlyHeader& header) {
  auto element = header.elements.begin();
  while (element->name != kPoints) ++element;
  return *element;
}

}  // namespace

PointTable parse_ply(std::string_view bytes, std::string_view name, Columns columns) {
  if (bytes.empty()) fail_at_byte(name, 0, "the file is empty, expected a PLY header");
  internal::LineReader lines(bytes);
  const PlyHeader header = internal::parse_ply_header(lines, name);
  const PlyElement& vertex = vertex_of(header);
  const TableLayout layout =
      internal::layout_of(value_names(vertex), columns, fmt::format("{}: line {}", name, vertex.line));
  if (header.format == PlyFormat::kAscii) return read_vertices(AsciiBody(lines, bytes, name), header, layout);
  const std::endian order = header.format == PlyFormat::kBinaryLittleEndian ? std::endian::little : std::endian::big;
  return read_vertices(BinaryBody(bytes, lines.offset(), order, name), header, layout);
}

}  // namespace trysquare
