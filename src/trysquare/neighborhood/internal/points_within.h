// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/neighborhood/internal/packed_tree.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace trysquare {

/// The test that decides: on the original doubles, in this order, without fused multiply-adds. The same as nanoflann's,
/// FLANN's and so map-metrics', digit for digit; coordinates with three decimals make exact ties common.
inline bool is_within(const Eigen::Vector3d& point, const Eigen::Vector3d& query, double squared_radius) {
  const double dx = point.x() - query.x();
  const double dy = point.y() - query.y();
  const double dz = point.z() - query.z();
  return (dx * dx + dy * dy) + dz * dz < squared_radius;
}

/// Whether a box can hold a point within the radius. Errs on the side of yes.
inline bool may_reach(const PointIndex::Tree& tree, std::size_t level, std::size_t node, const Eigen::Vector3d& query,
                      double squared_radius) {
  const Boxes& boxes = tree.boxes_of(level);
  const Eigen::Vector3d from_origin = query - tree.packed.origin;
  const double rounding = 0x1p-50 * (tree.packed.origin.cwiseAbs().maxCoeff() + query.cwiseAbs().maxCoeff());
  double squared_distance = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = from_origin[static_cast<Eigen::Index>(axis)];
    const double gap = std::max(static_cast<double>(boxes.lo[axis][node]) - at, at - boxes.hi[axis][node]) - rounding;
    if (gap > 0) squared_distance += gap * gap;
  }
  return !(squared_distance > squared_radius * (1 + 1e-12));
}

/// Calls visit(packed_index) for every point of the tree within the radius of the query, in packed order. The plain
/// way: what the kernels are tested against, and what they fall back to.
template <class Visit>
void for_each_point_within(const PointIndex::Tree& tree, const Eigen::Vector3d& query, double radius_m, Visit&& visit) {
  if (tree.packed.num_points == 0) return;
  const double squared_radius = radius_m * radius_m;
  struct Node {
    std::uint32_t level;
    std::uint32_t index;
  };
  std::array<Node, 128> stack;  // 7 siblings wait at each of at most 11 levels
  std::size_t depth = 0;
  stack[depth++] = {static_cast<std::uint32_t>(tree.top_level()), 0};
  while (depth > 0) {
    const Node node = stack[--depth];
    if (!may_reach(tree, node.level, node.index, query, squared_radius)) continue;
    if (node.level == 0) {
      for (std::size_t i = tree.first_point(0, node.index); i < tree.end_point(0, node.index); ++i) {
        if (is_within(tree.packed.point(i), query, squared_radius)) visit(i);
      }
      continue;
    }
    const std::size_t first = node.index * PointIndex::Tree::kFanOut;
    const std::size_t end = std::min(first + PointIndex::Tree::kFanOut, tree.boxes_of(node.level - 1).size);
    for (std::size_t child = end; child > first; --child) {
      stack[depth++] = {node.level - 1, static_cast<std::uint32_t>(child - 1)};
    }
  }
}

}  // namespace trysquare
