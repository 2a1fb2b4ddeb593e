// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_mesh.h"

#include "trysquare/core/error.h"
#include "trysquare/io/file.h"
#include "trysquare/io/internal/mesh_collector.h"
#include "trysquare/io/internal/ply_header.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {
namespace {

using internal::fail_at_byte;
using internal::fail_at_line;
using internal::in_quotes;
using internal::LineReader;
using internal::MeshCollector;
using internal::PlyElement;
using internal::PlyFormat;
using internal::PlyHeader;
using internal::PlyProperty;

// ---- OBJ

Eigen::Vector3d obj_vertex(internal::FieldReader fields, const std::string& where) {
  Eigen::Vector3d vertex;
  for (double& coordinate : vertex) {
    std::string_view field;
    const std::optional<double> value = fields.next(field) ? internal::parse_double(field) : std::nullopt;
    if (!value) throw IoError(fmt::format("{}found {}, expected v and three numbers", where, in_quotes(field)));
    coordinate = *value;
  }
  return vertex;
}

/// The vertex of a corner: the number before the first slash, counted from 1, or from the last one backwards.
double obj_corner(std::string_view field, std::size_t num_vertices, const std::string& where) {
  const std::optional<std::int64_t> number = internal::parse_integer(field.substr(0, field.find('/')));
  if (!number || *number == 0) {
    throw IoError(
        fmt::format("{}found {}, expected the number of a vertex, from 1 or from -1", where, in_quotes(field)));
  }
  const double from_end = *number < 0 ? static_cast<double>(num_vertices) : -1;
  return static_cast<double>(*number) + from_end;
}

// ---- PLY

/// The values of a binary body, one after the other.
class BinaryValues {
 public:
  BinaryValues(std::string_view bytes, std::size_t at, std::endian order, std::string_view name)
      : bytes_(bytes), at_(at), order_(order), name_(name) {}

  void begin_record(const PlyElement&) {}
  void end_record() {}
  std::string where() const { return fmt::format("{}: byte {}: ", name_, at_); }

  double next(internal::ScalarType type) {
    const std::size_t size = internal::size_of(type);
    if (size > bytes_.size() - at_) fail_at_byte(name_, at_, "the file ends early");
    const double value = internal::load_scalar(bytes_.data() + at_, type, order_);
    at_ += size;
    return value;
  }

 private:
  std::string_view bytes_;
  std::size_t at_;
  std::endian order_;
  std::string_view name_;
};

/// The values of a text body: one record a line.
class TextValues {
 public:
  TextValues(LineReader& lines, std::string_view bytes, std::string_view name)
      : lines_(lines), bytes_(bytes), name_(name) {}

  void begin_record(const PlyElement& element) {
    for (std::string_view line; lines_.next(line);) {
      if (internal::trimmed(line).empty()) continue;
      internal::read_numbers(name_, lines_.line_number(), line, values_);
      at_ = 0;
      return;
    }
    fail_at_byte(name_, bytes_.size(),
                 fmt::format("the file ends early, expected {} of element {}", element.count, in_quotes(element.name)));
  }
  void end_record() const {
    if (at_ != values_.size()) fail_count(at_);
  }
  std::string where() const { return fmt::format("{}: line {}: ", name_, lines_.line_number()); }

  double next(internal::ScalarType) {
    if (at_ == values_.size()) fail_count(at_ + 1);
    return values_[at_++];
  }

 private:
  [[noreturn]] void fail_count(std::size_t expected) const {
    fail_at_line(name_, lines_.line_number(),
                 fmt::format("found {} values, expected {}", values_.size(),
                             expected > values_.size() ? "more" : std::to_string(expected)));
  }

  LineReader& lines_;
  std::string_view bytes_;
  std::string_view name_;
  std::vector<double> values_;
  std::size_t at_ = 0;
};

/// Where the coordinates, or the corners, stand in a record; nullopt: not there.
std::optional<std::size_t> index_of(const PlyElement& element, std::string_view property, bool is_list) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& candidate = element.properties[i];
    if (candidate.name == property && candidate.list_count.has_value() == is_list) return i;
  }
  return std::nullopt;
}

/// The values of one list.
template <class Values>
void read_list(Values& values, const PlyProperty& property, std::vector<double>& items) {
  const std::string where = values.where();
  const double count = values.next(*property.list_count);
  if (!(count >= 0) || count != std::floor(count)) {
    throw IoError(fmt::format("{}found a list of {} items, expected 0 or more", where, count));
  }
  items.clear();
  for (double i = 0; i < count; ++i) items.push_back(values.next(property.type));
}

template <class Values>
void read_vertices(Values& values, const PlyElement& element, std::string_view name, MeshCollector& mesh) {
  std::array<std::size_t, 3> axes{};
  constexpr std::array<std::string_view, 3> kNames = {"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::optional<std::size_t> axis = index_of(element, kNames[k], false);
    if (!axis) fail_at_line(name, element.line, fmt::format("element vertex has no property {}", kNames[k]));
    axes[k] = *axis;
  }
  std::vector<double> record;
  std::vector<double> ignored;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    values.begin_record(element);
    const std::string where = values.where();
    record.clear();
    for (const PlyProperty& property : element.properties) {
      if (property.list_count) read_list(values, property, ignored);
      record.push_back(property.list_count ? 0 : values.next(property.type));
    }
    values.end_record();
    mesh.add_vertex({record[axes[0]], record[axes[1]], record[axes[2]]}, where);
  }
}

/// Records of any other element; `corners` is the list that makes a polygon, if there is one.
template <class Values>
void read_others(Values& values, const PlyElement& element, std::optional<std::size_t> corners, MeshCollector& mesh) {
  std::vector<double> items;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    values.begin_record(element);
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      const std::string where = values.where();
      if (!property.list_count) {
        values.next(property.type);
        continue;
      }
      read_list(values, property, items);
      if (corners == k) mesh.add_polygon(items, where);
    }
    values.end_record();
  }
}

template <class Values>
TriangleMesh read_body(Values values, const PlyHeader& header, std::string_view name) {
  MeshCollector mesh(name);
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(values, element, name, mesh);
      continue;
    }
    std::optional<std::size_t> corners;
    if (element.name == "face") {
      corners = index_of(element, "vertex_indices", true);
      if (!corners) corners = index_of(element, "vertex_index", true);
      if (!corners) fail_at_line(name, element.line, "element face has no list vertex_indices");
    }
    read_others(values, element, corners, mesh);
  }
  return mesh.take();
}

}  // namespace

TriangleMesh parse_obj(std::string_view text, std::string_view name) {
  MeshCollector mesh(name);
  LineReader lines(text);
  std::vector<double> corners;
  for (std::string_view line; lines.next(line);) {
    internal::FieldReader fields(line.substr(0, line.find('#')));
    std::string_view keyword;
    if (!fields.next(keyword) || (keyword != "v" && keyword != "f")) continue;
    const std::string where = fmt::format("{}: line {}: ", name, lines.line_number());
    if (keyword == "v") {
      mesh.add_vertex(obj_vertex(fields, where), where);
      continue;
    }
    corners.clear();
    for (std::string_view field; fields.next(field);) {
      corners.push_back(obj_corner(field, mesh.num_vertices(), where));
    }
    mesh.add_polygon(corners, where);
  }
  return mesh.take();
}

TriangleMesh parse_ply_mesh(std::string_view bytes, std::string_view name) {
  if (bytes.empty()) fail_at_byte(name, 0, "the file is empty, expected a PLY header");
  LineReader lines(bytes);
  const PlyHeader header = internal::parse_ply_header(lines, name);
  if (header.format == PlyFormat::kAscii) return read_body(TextValues(lines, bytes, name), header, name);
  const std::endian order = header.format == PlyFormat::kBinaryLittleEndian ? std::endian::little : std::endian::big;
  return read_body(BinaryValues(bytes, lines.offset(), order, name), header, name);
}

TriangleMesh read_mesh(const std::filesystem::path& path) {
  const std::string extension = internal::lower_case(path.extension().string());
  if (extension != ".obj" && extension != ".ply") {
    throw IoError(fmt::format("{}: the ending of a mesh must be .obj or .ply", path.string()));
  }
  const std::string bytes = read_file(path);
  return extension == ".obj" ? parse_obj(bytes, path.string()) : parse_ply_mesh(bytes, path.string());
}

}  // namespace trysquare
