// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_pcd.h"

#include "trysquare/io/internal/pcd_header.h"
#include "trysquare/io/internal/record_size.h"
#include "trysquare/io/internal/table_layout.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>
#include <liblzf/lzf.h>

#include <limits>

namespace trysquare {
namespace {

using internal::fail_at_byte;
using internal::fail_at_line;
using internal::PcdField;
using internal::PcdHeader;
using internal::ScalarType;
using internal::StridedScalars;
using internal::TableLayout;

bool is_padding(const PcdField& field) { return field.name == "_"; }

std::vector<std::string> value_names(const std::vector<PcdField>& fields) {
  std::vector<std::string> names;
  for (const PcdField& field : fields) {
    for (std::size_t i = 0; i < field.count; ++i) {
      names.push_back(is_padding(field) ? "" : field.count == 1 ? field.name : fmt::format("{}_{}", field.name, i));
    }
  }
  return names;
}

std::size_t bytes_of(const PcdField& field) { return field.count * internal::size_of(field.type); }

/// DATA binary: point after point.
std::vector<StridedScalars> interleaved_values(const std::vector<PcdField>& fields, std::string_view body) {
  std::size_t stride = 0;
  for (const PcdField& field : fields) stride += bytes_of(field);
  std::vector<StridedScalars> values;
  std::size_t offset = 0;
  for (const PcdField& field : fields) {
    for (std::size_t i = 0; i < field.count; ++i, offset += internal::size_of(field.type)) {
      values.push_back({body.data() + offset, stride, field.type, std::endian::little});
    }
  }
  return values;
}

/// DATA binary_compressed, once unpacked: field after field, each with the values of all points.
std::vector<StridedScalars> planar_values(const std::vector<PcdField>& fields, std::size_t num_points,
                                          std::string_view body, bool padding_is_stored) {
  std::vector<StridedScalars> values;
  std::size_t offset = 0;
  for (const PcdField& field : fields) {
    const bool stored = padding_is_stored || !is_padding(field);
    for (std::size_t i = 0; i < field.count; ++i) {
      const std::size_t at = stored ? offset + i * internal::size_of(field.type) : 0;
      values.push_back({body.data() + at, bytes_of(field), field.type, std::endian::little});
    }
    if (stored) offset += num_points * bytes_of(field);
  }
  return values;
}

PointTable parse_ascii(internal::LineReader& lines, std::string_view bytes, std::string_view name,
                       const PcdHeader& header, const TableLayout& layout) {
  internal::require_text_for(header.num_points, layout.num_values, bytes, lines, name);
  PointTable table = internal::empty_table(layout);
  table.points.reserve(static_cast<std::size_t>(header.num_points));
  std::vector<double> row;
  for (std::string_view line; lines.next(line);) {
    if (internal::trimmed(line).empty()) continue;
    if (table.points.size() == header.num_points) {
      fail_at_line(name, lines.line_number(), fmt::format("found another line, expected {} points", header.num_points));
    }
    internal::read_numbers(name, lines.line_number(), line, row);
    if (row.size() != layout.num_values) {
      fail_at_line(name, lines.line_number(),
                   fmt::format("found {} values, expected {}", row.size(), layout.num_values));
    }
    internal::append_row(row, layout, table);
  }
  if (table.points.size() != header.num_points) {
    fail_at_byte(name, bytes.size(),
                 fmt::format("the file ends after {} points, expected {}", table.points.size(), header.num_points));
  }
  return table;
}

PointTable parse_binary(std::string_view body, std::size_t body_offset, std::string_view name, const PcdHeader& header,
                        const TableLayout& layout) {
  const std::vector<StridedScalars> values = interleaved_values(header.fields, body);
  const std::size_t stride = values.front().stride;
  internal::require_bytes_for(header.num_points, stride, body, body_offset, name);
  if (body.size() - header.num_points * stride >= stride) {
    fail_at_byte(name, body_offset + header.num_points * stride,
                 fmt::format("found {} more bytes, expected the end of the file after {} points of {} bytes",
                             body.size() - header.num_points * stride, header.num_points, stride));
  }
  return internal::gather_table(layout, static_cast<std::size_t>(header.num_points),
                                [&](std::size_t value) { return values[value]; });
}

/// The sizes before the compressed bytes, checked against each other, the header and what LZF can do, before any memory
/// is taken for them.
struct CompressedBody {
  std::string_view compressed;
  std::size_t unpacked_size = 0;
  bool padding_is_stored = false;
};

CompressedBody check_compressed(std::string_view body, std::size_t body_offset, std::string_view name,
                                const PcdHeader& header) {
  constexpr std::size_t kSizesBytes = 8;
  constexpr std::size_t kLargestExpansion = 88;  // three bytes of LZF stand for 264 at most
  if (body.size() < kSizesBytes) {
    fail_at_byte(
        name, body_offset,
        fmt::format("found {} bytes, expected {} for the compressed and uncompressed size", body.size(), kSizesBytes));
  }
  const auto size_at = [&](std::size_t at) {
    return static_cast<std::size_t>(internal::load_scalar(body.data() + at, ScalarType::kUint32, std::endian::little));
  };
  const std::size_t compressed_size = size_at(0);
  CompressedBody result{body.substr(kSizesBytes), size_at(4), false};
  if (compressed_size > result.compressed.size()) {
    fail_at_byte(name, body_offset,
                 fmt::format("the compressed points end early: {} bytes, expected {}", result.compressed.size(),
                             compressed_size));
  }
  result.compressed = result.compressed.substr(0, compressed_size);
  std::uint64_t stride = 0;
  std::uint64_t stride_without_padding = 0;
  for (const PcdField& field : header.fields) {
    stride += bytes_of(field);
    stride_without_padding += is_padding(field) ? 0 : bytes_of(field);
  }
  const bool overflows = header.num_points > std::numeric_limits<std::uint32_t>::max();
  result.padding_is_stored = !overflows && result.unpacked_size == header.num_points * stride;
  if (overflows || (!result.padding_is_stored && result.unpacked_size != header.num_points * stride_without_padding)) {
    fail_at_byte(name, body_offset + 4,
                 fmt::format("the uncompressed size is {}, expected {} points of {} bytes", result.unpacked_size,
                             header.num_points, stride));
  }
  if (result.unpacked_size > kLargestExpansion * compressed_size) {
    fail_at_byte(name, body_offset + 4,
                 fmt::format("the uncompressed size is {}, more than {} bytes of LZF can stand for",
                             result.unpacked_size, compressed_size));
  }
  return result;
}

PointTable parse_compressed(std::string_view body, std::size_t body_offset, std::string_view name,
                            const PcdHeader& header, const TableLayout& layout) {
  const CompressedBody checked = check_compressed(body, body_offset, name, header);
  std::string unpacked(checked.unpacked_size, '\0');
  if (!unpacked.empty()) {
    const unsigned size = lzf_decompress(checked.compressed.data(), static_cast<unsigned>(checked.compressed.size()),
                                         unpacked.data(), static_cast<unsigned>(unpacked.size()));
    if (size != unpacked.size()) {
      fail_at_byte(
          name, body_offset + 8,
          fmt::format("the compressed points are damaged: LZF gives {} bytes, expected {}", size, unpacked.size()));
    }
  }
  const auto num_points = static_cast<std::size_t>(header.num_points);
  const std::vector<StridedScalars> values =
      planar_values(header.fields, num_points, unpacked, checked.padding_is_stored);
  return internal::gather_table(layout, num_points, [&](std::size_t value) { return values[value]; });
}

}  // namespace

PointTable parse_pcd(std::string_view bytes, std::string_view name, Columns columns) {
  if (bytes.empty()) fail_at_byte(name, 0, "the file is empty, expected a PCD header");
  internal::LineReader lines(bytes);
  const PcdHeader header = internal::parse_pcd_header(lines, name);
  const TableLayout layout =
      internal::layout_of(value_names(header.fields), columns, fmt::format("{}: line {}", name, header.fields_line));
  const std::size_t body_offset = lines.offset();
  const std::string_view body = bytes.substr(body_offset);
  switch (header.data) {
    case internal::PcdData::kAscii:
      break;
    case internal::PcdData::kBinary:
      return parse_binary(body, body_offset, name, header, layout);
    case internal::PcdData::kBinaryCompressed:
      return parse_compressed(body, body_offset, name, header, layout);
  }
  return parse_ascii(lines, bytes, name, header, layout);
}

}  // namespace trysquare
