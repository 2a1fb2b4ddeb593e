// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/internal/scalars.h"
#include "trysquare/io/internal/text.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trysquare::internal {

enum class PcdData { kAscii, kBinary, kBinaryCompressed };

struct PcdField {
  std::string name;
  ScalarType type = ScalarType::kFloat32;
  std::size_t count = 1;  ///< Values a point.
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t num_points = 0;  ///< As claimed: nothing is known about the body yet.
  PcdData data = PcdData::kAscii;
  std::size_t fields_line = 0;  ///< Where the fields are named, for messages.
};

/// Reads up to and including the DATA line, behind which `lines` then stands.
/// @throws IoError  if the header contradicts itself.
PcdHeader parse_pcd_header(LineReader& lines, std::string_view name);

}  // namespace trysquare::internal
