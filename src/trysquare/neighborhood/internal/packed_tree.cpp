// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/internal/packed_tree.h"

#include "trysquare/parallel/for_each_block.h"

#include <algorithm>
#include <utility>

namespace trysquare {
namespace {

using Tree = PointIndex::Tree;

MomentRow moments_of_leaf(const PackedPoints& packed, std::size_t leaf, const Eigen::Vector3d& center) {
  const Eigen::Vector3d about = packed.origin + center;
  MomentRow sums;
  for (std::size_t i = 0; i < packed.points_in_leaf(leaf); ++i) {
    sums.add_point(packed.leaf_axis(leaf, 0)[i] - about.x(), packed.leaf_axis(leaf, 1)[i] - about.y(),
                   packed.leaf_axis(leaf, 2)[i] - about.z());
  }
  return sums;
}

void fill_box(const Boxes& children, std::size_t first, std::size_t end, std::size_t node, Boxes& boxes) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto lo = children.lo[axis].begin();
    const auto hi = children.hi[axis].begin();
    const auto begin = static_cast<std::ptrdiff_t>(first);
    const auto last = static_cast<std::ptrdiff_t>(end);
    boxes.lo[axis][node] = *std::min_element(lo + begin, lo + last);
    boxes.hi[axis][node] = *std::max_element(hi + begin, hi + last);
  }
}

/// The level above `tree.top_level()`.
void add_level(Tree& tree, const Execution& execution) {
  constexpr std::size_t kNodesPerBlock = 512;
  const std::size_t below = tree.top_level();
  const Boxes& children = tree.boxes_of(below);
  Tree::Level level;
  level.boxes.resize((children.size + Tree::kFanOut - 1) / Tree::kFanOut);
  level.moments.resize(level.boxes.size);
  for_each_block(level.boxes.size, kNodesPerBlock, {.num_threads = execution.num_threads}, "", [&](const Block& block) {
    for (std::size_t node = block.begin; node < block.end; ++node) {
      const std::size_t first = node * Tree::kFanOut;
      const std::size_t end = std::min(first + Tree::kFanOut, children.size);
      fill_box(children, first, end, node, level.boxes);
      const Eigen::Vector3d center = level.center(node);
      for (std::size_t child = first; child < end; ++child) {
        if (below == 0) {
          level.moments[node].add(moments_of_leaf(tree.packed, child, center));
        } else {
          const Tree::Level& children_level = tree.levels[below - 1];
          // Rounded as the leaves' sums are: far from the origin the difference of the offsets alone is another one.
          const Eigen::Vector3d from = tree.packed.origin + children_level.center(child);
          level.moments[node].add(children_level.moments[child].shifted(from - (tree.packed.origin + center)));
        }
      }
    }
  });
  tree.levels.push_back(std::move(level));
}

std::size_t points_per_node(std::size_t level) {
  std::size_t count = PackedPoints::kLeafSize;
  for (std::size_t i = 0; i < level; ++i) count *= Tree::kFanOut;
  return count;
}

void add_levels(Tree& tree, const Execution& execution) {
  if (tree.packed.num_points == 0) return;
  do {
    add_level(tree, execution);
  } while (tree.levels.back().boxes.size > 1);
}

}  // namespace

Eigen::Vector3d Tree::Level::center(std::size_t node) const {
  Eigen::Vector3d center;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    center[static_cast<Eigen::Index>(axis)] = 0.5F * (boxes.lo[axis][node] + boxes.hi[axis][node]);
  }
  return center;
}

Tree::Tree(PointsView points_in_map, std::span<const std::uint32_t> scan_of_point, std::size_t scan_count,
           const Execution& execution)
    : source(points_in_map),
      cube(hilbert_cube_around(points_in_map)),
      packed(points_in_map, hilbert_order(points_in_map, cube, execution), cube.origin(), execution),
      scans(scan_of_point.size()),
      num_scans(scan_count) {
  for (std::size_t i = 0; i < scans.size(); ++i) scans[i] = scan_of_point[packed.original_index[i]];
  add_levels(*this, execution);
}

Tree::Tree(PointsView points_in_map, std::vector<std::uint32_t> order, const Eigen::Vector3d& origin)
    : source(points_in_map), packed(points_in_map, std::move(order), origin, {.num_threads = 1}) {
  add_levels(*this, {.num_threads = 1});
}

std::size_t Tree::first_point(std::size_t level, std::size_t node) const { return node * points_per_node(level); }

std::size_t Tree::end_point(std::size_t level, std::size_t node) const {
  return std::min((node + 1) * points_per_node(level), packed.num_points);
}

}  // namespace trysquare
