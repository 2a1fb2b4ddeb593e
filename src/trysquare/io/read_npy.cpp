// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_npy.h"

#include "trysquare/io/internal/record_size.h"
#include "trysquare/io/internal/table_layout.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>

namespace trysquare {
namespace {

using internal::fail_at_byte;
using internal::in_quotes;
using internal::ScalarType;
using internal::StridedScalars;

struct NpyHeader {
  std::string descr;  ///< The literal as it stands: quoted for plain arrays, a list for structured ones.
  std::optional<bool> fortran_order;
  std::optional<std::vector<std::int64_t>> shape;
  std::size_t body_offset = 0;
};

/// Reads the header's Python dictionary: {'descr': '<f8', 'fortran_order': False, 'shape': (39, 3), }
class DictionaryReader {
 public:
  DictionaryReader(std::string_view text, std::size_t offset, std::string_view name)
      : text_(text), offset_(offset), name_(name) {}

  void read_into(NpyHeader& header) {
    expect('{');
    while (!accept('}')) {
      const std::string key = read_string();
      expect(':');
      read_value(key, header);
      if (!accept(',') && !at('}')) fail("expected , or }");
    }
  }

 private:
  [[noreturn]] void fail(std::string_view expected) const {
    fail_at_byte(name_, offset_ + at_,
                 fmt::format("in the NPY header found {}, {}", in_quotes(text_.substr(at_, 12)), expected));
  }

  void skip_space() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\t')) ++at_;
  }

  bool at(char c) {
    skip_space();
    return at_ < text_.size() && text_[at_] == c;
  }

  bool accept(char c) {
    const bool found = at(c);
    at_ += found ? 1 : 0;
    return found;
  }

  void expect(char c) {
    if (!accept(c)) fail(fmt::format("expected {}", c));
  }

  std::string read_string() {
    const char quote = at('"') ? '"' : '\'';
    expect(quote);
    const std::size_t end = text_.find(quote, at_);
    if (end == std::string_view::npos) fail("expected the end of a string");
    std::string value(text_.substr(at_, end - at_));
    at_ = end + 1;
    return value;
  }

  void read_value(const std::string& key, NpyHeader& header) {
    if (key == "descr") {
      if (at('[')) fail_at_byte(name_, offset_ + at_, "it is a structured array, expected a plain array of floats");
      header.descr = read_string();
    } else if (key == "fortran_order") {
      header.fortran_order = read_bool();
    } else if (key == "shape") {
      header.shape = read_shape();
    } else {
      fail(fmt::format("behind the key {}, expected descr, fortran_order and shape only", in_quotes(key)));
    }
  }

  bool read_bool() {
    skip_space();
    for (const bool value : {false, true}) {
      const std::string_view word = value ? "True" : "False";
      if (text_.substr(at_).starts_with(word)) {
        at_ += word.size();
        return value;
      }
    }
    fail("expected True or False");
  }

  std::vector<std::int64_t> read_shape() {
    constexpr std::size_t kMaxDimensions = 32;  // numpy's own limit
    std::vector<std::int64_t> shape;
    expect('(');
    while (!accept(')')) {
      skip_space();
      const std::size_t end = std::min(text_.find_first_of(",) L", at_), text_.size());
      const std::optional<std::int64_t> size = internal::parse_integer(text_.substr(at_, end - at_));
      if (!size || *size < 0 || shape.size() == kMaxDimensions) fail("expected the size of a dimension");
      shape.push_back(*size);
      at_ = end;
      accept('L');  // Python 2 wrote long integers like this
      if (!accept(',') && !at(')')) fail("expected , or )");
    }
    return shape;
  }

  std::string_view text_;
  std::size_t offset_;
  std::string_view name_;
  std::size_t at_ = 0;
};

NpyHeader parse_header(std::string_view bytes, std::string_view name) {
  constexpr std::string_view kMagic = "\x93NUMPY";
  if (bytes.empty()) fail_at_byte(name, 0, "the file is empty, expected an NPY header");
  if (!bytes.starts_with(kMagic)) {
    fail_at_byte(name, 0, fmt::format("found {}, expected \\x93NUMPY", in_quotes(bytes.substr(0, kMagic.size()))));
  }
  const int version = bytes.size() > kMagic.size() ? static_cast<unsigned char>(bytes[kMagic.size()]) : 0;
  if (version < 1 || version > 3) {
    fail_at_byte(name, kMagic.size(), fmt::format("found version {}, expected 1, 2 or 3", version));
  }
  const std::size_t length_at = kMagic.size() + 2;
  const ScalarType length_type = version == 1 ? ScalarType::kUint16 : ScalarType::kUint32;
  const std::size_t text_at = length_at + internal::size_of(length_type);
  if (bytes.size() < text_at) fail_at_byte(name, bytes.size(), "the file ends within the NPY header");
  const auto length =
      static_cast<std::size_t>(internal::load_scalar(bytes.data() + length_at, length_type, std::endian::little));
  if (length > bytes.size() - text_at) {
    fail_at_byte(name, text_at,
                 fmt::format("the NPY header ends early: {} bytes, expected {}", bytes.size() - text_at, length));
  }
  NpyHeader header;
  header.body_offset = text_at + length;
  DictionaryReader(bytes.substr(text_at, length), text_at, name).read_into(header);
  if (header.descr.empty() || !header.fortran_order || !header.shape) {
    fail_at_byte(name, text_at, "the NPY header is incomplete, expected descr, fortran_order and shape");
  }
  return header;
}

StridedScalars scalars_of(const NpyHeader& header, std::string_view name) {
  if (header.descr.find('O') != std::string::npos) {
    fail_at_byte(name, header.body_offset,
                 "it is a pickled object array, which is never unpickled (a pickle can run any code); expected a plain "
                 "array of shape (N, 3): save one file for each direction, numpy.save(\"direction-0.npy\", array[0])");
  }
  StridedScalars scalars;
  const std::string_view type = std::string_view(header.descr).substr(1);
  scalars.type = type == "f4" ? ScalarType::kFloat32 : ScalarType::kFloat64;
  scalars.order = header.descr[0] == '>' ? std::endian::big : std::endian::little;
  const bool known_order = header.descr[0] == '<' || header.descr[0] == '>' || header.descr[0] == '=';
  if (!known_order || (type != "f4" && type != "f8")) {
    fail_at_byte(
        name, header.body_offset,
        fmt::format("the array holds {}, expected float32 or float64 (<f4, <f8, >f4, >f8)", in_quotes(header.descr)));
  }
  return scalars;
}

}  // namespace

PointTable parse_npy(std::string_view bytes, std::string_view name, Columns columns) {
  const NpyHeader header = parse_header(bytes, name);
  const StridedScalars scalars = scalars_of(header, name);
  const std::vector<std::int64_t>& shape = *header.shape;
  if (shape.size() != 2 || shape[1] < 3 || shape[1] > static_cast<std::int64_t>(internal::kMaxValuesPerPoint)) {
    fail_at_byte(name, header.body_offset,
                 fmt::format("the array has the shape ({}), expected (N, 3) or (N, k), k > 3", fmt::join(shape, ", ")));
  }
  const auto num_points = static_cast<std::size_t>(shape[0]);
  const auto num_values = static_cast<std::size_t>(shape[1]);
  const std::size_t size = internal::size_of(scalars.type);
  const std::string_view body = bytes.substr(header.body_offset);
  internal::require_bytes_for(num_points, num_values * size, body, header.body_offset, name);
  if (body.size() != num_points * num_values * size) {
    fail_at_byte(name, header.body_offset + num_points * num_values * size,
                 fmt::format("found {} more bytes, expected the end of the array",
                             body.size() - num_points * num_values * size));
  }
  return internal::gather_table(
      internal::layout_of(internal::unnamed_values(num_values), columns, name), num_points, [&](std::size_t value) {
        StridedScalars column = scalars;
        column.first = body.data() + (*header.fortran_order ? value * num_points : value) * size;
        column.stride = *header.fortran_order ? size : num_values * size;
        return column;
      });
}

}  // namespace trysquare
