// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_bin.h"

#include "trysquare/io/internal/table_layout.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>

namespace trysquare {
namespace {

PointTable parse_float_records(std::string_view bytes, std::string_view name, const std::vector<std::string>& fields,
                               Columns columns) {
  constexpr auto kType = internal::ScalarType::kFloat32;
  const std::size_t stride = fields.size() * internal::size_of(kType);
  if (bytes.empty())
    internal::fail_at_byte(name, 0, fmt::format("the file is empty, expected points of {} bytes", stride));
  if (bytes.size() % stride != 0) {
    internal::fail_at_byte(
        name, bytes.size(),
        fmt::format("the file ends within a point: {} bytes, expected a multiple of {}", bytes.size(), stride));
  }
  return internal::gather_table(internal::layout_of(fields, columns, name), bytes.size() / stride,
                                [&](std::size_t value) {
                                  return internal::StridedScalars{bytes.data() + value * internal::size_of(kType),
                                                                  stride, kType, std::endian::little};
                                });
}

}  // namespace

PointTable parse_kitti_bin(std::string_view bytes, std::string_view name, Columns columns) {
  return parse_float_records(bytes, name, {"x", "y", "z", "intensity"}, columns);
}

PointTable parse_nuscenes_bin(std::string_view bytes, std::string_view name, Columns columns) {
  return parse_float_records(bytes, name, {"x", "y", "z", "intensity", "ring"}, columns);
}

}  // namespace trysquare
