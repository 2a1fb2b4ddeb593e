// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"
#include "trysquare/core/registered_map.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace trysquare {

/// Spatial index over the points of one map. Refers to them: the points must outlive the index, unchanged.
/// Immutable after construction; any number of threads may query it.
class PointIndex {
 public:
  /// @param points_in_map  N points, finite [m].
  /// @param scan_of_point  N indices < num_scans, or empty: neighborhoods then count 0 scans.
  /// @throws InvalidArgument  on a coordinate that is not finite, a scan index out of range, differing lengths, or
  ///                          more than 2³² − 1 points.
  PointIndex(PointsView points_in_map, std::span<const std::uint32_t> scan_of_point, std::size_t num_scans);

  explicit PointIndex(const RegisteredMap& map);
  explicit PointIndex(PointsView points_in_map) : PointIndex(points_in_map, {}, 0) {}

  ~PointIndex();
  PointIndex(PointIndex&&) noexcept;
  PointIndex& operator=(PointIndex&&) noexcept;
  PointIndex(const PointIndex&) = delete;
  PointIndex& operator=(const PointIndex&) = delete;

  PointsView points() const;
  std::size_t num_scans() const;

  class Tree;  ///< The search structure, private to neighborhood/.
  const Tree& tree() const { return *tree_; }

 private:
  std::unique_ptr<Tree> tree_;
};

}  // namespace trysquare
