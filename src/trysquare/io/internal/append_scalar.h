// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace trysquare::internal {

/// Appends the bytes of a number, lowest first, on every machine.
template <class T>
void append_little_endian(T value, std::string& bytes) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

}  // namespace trysquare::internal
