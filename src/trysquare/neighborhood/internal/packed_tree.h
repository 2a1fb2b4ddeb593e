// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/neighborhood/internal/moment_row.h"
#include "trysquare/neighborhood/internal/packed_points.h"
#include "trysquare/neighborhood/point_index.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace trysquare {

/// @throws InvalidArgument  naming `name` and the index of a point that is not finite or beyond 1e150 m.
void validate_points(std::string_view name, PointsView points);

/// A tree without pointers over packed points: node k of a level has the nodes 8k … 8k + 7 of the level below as its
/// children; the leaves are level 0. Nodes above the leaves know the moments of their points, so a node wholly inside
/// a ball costs the same however many points it holds.
class PointIndex::Tree {
 public:
  static constexpr std::size_t kFanOut = 8;

  /// Nodes above the leaves.
  struct Level {
    Boxes boxes;
    std::vector<MomentRow> moments;  ///< About center().

    Eigen::Vector3d center(std::size_t node) const;  ///< Relative to the origin of the packed points.
  };

  /// Over points along a Hilbert curve.
  Tree(PointsView points_in_map, std::span<const std::uint32_t> scan_of_point, std::size_t num_scans,
       const Execution& execution);

  /// Over points in a given order, or as they come when `order` is empty; without scan identity.
  Tree(PointsView points_in_map, std::vector<std::uint32_t> order, const Eigen::Vector3d& origin);

  const Boxes& boxes_of(std::size_t level) const { return level == 0 ? packed.leaf_boxes : levels[level - 1].boxes; }
  /// At least 1, unless there are no points.
  std::size_t top_level() const { return levels.size(); }
  std::size_t first_point(std::size_t level, std::size_t node) const;
  std::size_t end_point(std::size_t level, std::size_t node) const;  ///< One past the last.
  bool has_scans() const { return !scans.empty(); }

  PointsView source;
  HilbertCube cube;
  PackedPoints packed;
  std::vector<std::uint32_t> scans;  ///< Of the packed points; empty when the map carries no scan identity.
  std::size_t num_scans = 0;
  std::vector<Level> levels;  ///< levels[i] is level i + 1.
};

}  // namespace trysquare
