// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/write_npy.h"

#include "trysquare/io/internal/append_scalar.h"

#include <fmt/format.h>

#include <cstdint>

namespace trysquare {

std::string format_npy(std::span<const double> values, std::size_t num_columns) {
  constexpr std::size_t kAlignment = 64;
  constexpr std::size_t kPrefix = 10;  // magic, version, length of the header
  const std::string shape = num_columns == 0 ? fmt::format("({},)", values.size())
                                             : fmt::format("({}, {})", values.size() / num_columns, num_columns);
  std::string header = fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': {}, }}", shape);
  header.append(kAlignment - (kPrefix + header.size() + 1) % kAlignment, ' ');
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes.append({'\1', '\0'});
  internal::append_little_endian(static_cast<std::uint16_t>(header.size()), bytes);
  bytes += header;
  for (const double value : values) internal::append_little_endian(value, bytes);
  return bytes;
}

}  // namespace trysquare
