// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/internal/scalars.h"
#include "trysquare/io/internal/text.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trysquare::internal {

enum class PlyFormat { kAscii, kBinaryLittleEndian, kBinaryBigEndian };

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::kFloat32;  ///< Of the value, or of a list's items.
  std::optional<ScalarType> list_count;    ///< Only lists: the type of the number of items before them.
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< As claimed: nothing is known about the body yet.
  std::size_t line = 0;
  std::vector<PlyProperty> properties;

  bool has_lists() const;

  /// [bytes] of one record with empty lists: all of it when there are no lists.
  std::size_t smallest_size() const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;  ///< Each has properties, one is called vertex.
};

/// Reads up to and including the line end_header, behind which `lines` then stands.
/// @throws IoError  naming the line.
PlyHeader parse_ply_header(LineReader& lines, std::string_view name);

}  // namespace trysquare::internal
