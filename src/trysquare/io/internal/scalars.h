// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>

namespace trysquare::internal {

/// What binary point files hold.
enum class ScalarType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat32, kFloat64 };

std::size_t size_of(ScalarType type);

/// One value of every record in a run of records.
struct StridedScalars {
  const char* first = nullptr;
  std::size_t stride = 0;  ///< [bytes] from one record to the next.
  ScalarType type = ScalarType::kFloat64;
  std::endian order = std::endian::little;
};

double load_scalar(const char* at, ScalarType type, std::endian order);

/// Converts `count` values to double, which is exact but for 64-bit integers beyond 2^53.
/// @param to  receives value i at to[i * to_stride].
void copy_scalars(const StridedScalars& from, std::size_t count, double* to, std::size_t to_stride);

}  // namespace trysquare::internal
