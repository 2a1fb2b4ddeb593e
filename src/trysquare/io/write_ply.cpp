// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/write_ply.h"

#include "trysquare/core/error.h"
#include "trysquare/io/internal/append_scalar.h"
#include "trysquare/io/internal/replacing_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace trysquare {
namespace {

void validate(const PointTable& table) {
  for (const PointTable::Column& column : table.columns) {
    if (column.values.size() != table.points.size()) {
      throw InvalidArgument(fmt::format("column {} has {} values, expected {}, one for each point", column.name,
                                        column.values.size(), table.points.size()));
    }
  }
  if (!table.colors.empty() && table.colors.size() != table.points.size()) {
    throw InvalidArgument(
        fmt::format("{} colors, expected {}, one for each point", table.colors.size(), table.points.size()));
  }
}

std::string property_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) <= ' '; }, '_');
  return name.starts_with("scalar_") ? name : "scalar_" + name;
}

std::string header_of(const PointTable& table) {
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n",
      table.points.size());
  if (!table.colors.empty()) header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  for (const PointTable::Column& column : table.columns) {
    header += fmt::format("property float {}\n", property_name(column.name));
  }
  return header + "end_header\n";
}

}  // namespace

void write_ply(const std::filesystem::path& path, const PointTable& table) {
  constexpr std::size_t kPieceBytes = 1 << 20;
  validate(table);
  internal::ReplacingFile file(path);
  std::string piece = header_of(table);
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    for (const double coordinate : table.points[i]) internal::append_little_endian(coordinate, piece);
    if (!table.colors.empty()) {
      for (const std::uint8_t part : table.colors[i]) piece += static_cast<char>(part);
    }
    for (const PointTable::Column& column : table.columns) {
      internal::append_little_endian(static_cast<float>(column.values[i]), piece);
    }
    if (piece.size() >= kPieceBytes) {
      file.write(piece);
      piece.clear();
    }
  }
  file.write(piece);
  file.commit();
}

}  // namespace trysquare
