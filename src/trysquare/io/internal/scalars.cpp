// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/scalars.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>

namespace trysquare::internal {
namespace {

template <class T>
T load(const char* at, bool swap) {
  std::array<char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), at, sizeof(T));
  if (swap) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

/// Calls visit with a value of the C++ type that `type` stands for.
template <class Visit>
auto with_type(ScalarType type, Visit&& visit) {
  switch (type) {
    case ScalarType::kInt8:
      return visit(std::int8_t{});
    case ScalarType::kUint8:
      return visit(std::uint8_t{});
    case ScalarType::kInt16:
      return visit(std::int16_t{});
    case ScalarType::kUint16:
      return visit(std::uint16_t{});
    case ScalarType::kInt32:
      return visit(std::int32_t{});
    case ScalarType::kUint32:
      return visit(std::uint32_t{});
    case ScalarType::kInt64:
      return visit(std::int64_t{});
    case ScalarType::kUint64:
      return visit(std::uint64_t{});
    case ScalarType::kFloat32:
      return visit(float{});
    case ScalarType::kFloat64:
      break;
  }
  assert(type == ScalarType::kFloat64);
  return visit(double{});
}

}  // namespace

std::size_t size_of(ScalarType type) {
  return with_type(type, [](auto zero) { return sizeof(zero); });
}

double load_scalar(const char* at, ScalarType type, std::endian order) {
  const bool swap = order != std::endian::native;
  return with_type(type, [&](auto zero) { return static_cast<double>(load<decltype(zero)>(at, swap)); });
}

void copy_scalars(const StridedScalars& from, std::size_t count, double* to, std::size_t to_stride) {
  const bool swap = from.order != std::endian::native;
  with_type(from.type, [&](auto zero) {
    for (std::size_t i = 0; i < count; ++i) {
      to[i * to_stride] = static_cast<double>(load<decltype(zero)>(from.first + i * from.stride, swap));
    }
  });
}

}  // namespace trysquare::internal
