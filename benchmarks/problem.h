// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace trysquare::bench {

/// Which points of a map are queries.
struct QuerySettings {
  std::size_t every = 1;     ///< Of blocks of 64 consecutive points, one out of so many; 1: all points. >= 1.
  bool fixed_scan0 = false;  ///< Only points of scan 0, however many scans the map has.
};

/// What every engine is given: the same points in the same memory, and the same queries.
struct Problem {
  std::vector<Eigen::Vector3d> points_in_map;  ///< [m], in scan order.
  std::vector<std::uint32_t> scan_of_point;
  std::size_t num_scans = 0;
  std::vector<Eigen::Vector3d> subset_in_map;  ///< The queries, when they are not all points.
  bool queries_are_all_points = true;
  double radius_m = 1.0;
  int num_threads = 1;

  /// All points are the very span of points_in_map, which saves trysquare from sorting them a second time.
  std::span<const Eigen::Vector3d> queries_in_map() const {
    return queries_are_all_points ? std::span<const Eigen::Vector3d>(points_in_map) : subset_in_map;
  }
};

/// Reads little-endian float64 records x, y, z, scan. Piece by piece, so that reading never needs more memory than the
/// points: the peak memory of the process is to be that of the engine.
/// @throws std::runtime_error  naming the path, if it cannot be read, is no whole number of records, or is out of
/// order.
Problem read_problem(const std::filesystem::path& path, const QuerySettings& settings);

/// Writes what read_problem() reads. @throws std::runtime_error  naming the path.
void write_map_file(const std::filesystem::path& path, std::span<const Eigen::Vector3d> points_in_map,
                    std::span<const std::uint32_t> scan_of_point);

}  // namespace trysquare::bench
