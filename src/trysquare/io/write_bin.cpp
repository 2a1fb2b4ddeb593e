// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/write_bin.h"

#include "trysquare/io/file.h"
#include "trysquare/io/internal/append_scalar.h"

#include <string>

namespace trysquare {

void write_kitti_bin(const std::filesystem::path& path, PointsView points_in_scan) {
  constexpr std::size_t kBytesPerPoint = 16;
  std::string bytes;
  bytes.reserve(points_in_scan.size() * kBytesPerPoint);
  for (const Eigen::Vector3d& point : points_in_scan) {
    for (const double coordinate : point) internal::append_little_endian(static_cast<float>(coordinate), bytes);
    internal::append_little_endian(0.0F, bytes);
  }
  write_file(path, bytes);
}

}  // namespace trysquare
