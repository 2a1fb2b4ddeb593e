// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/internal/packed_points.h"

#include "trysquare/parallel/for_each_block.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace trysquare {
namespace {

void fill_leaf(PointsView points, std::size_t leaf, PackedPoints& packed) {
  const std::size_t first = leaf * PackedPoints::kLeafSize;
  const std::size_t count = packed.points_in_leaf(leaf);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double* to = packed.coordinates.data() + (3 * leaf + axis) * PackedPoints::kLeafSize;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t index = packed.original_index.empty() ? first + i : packed.original_index[first + i];
      to[i] = points[index][static_cast<Eigen::Index>(axis)];
      lowest = std::min(lowest, to[i]);
      highest = std::max(highest, to[i]);
    }
    std::fill(to + count, to + PackedPoints::kLeafSize, std::numeric_limits<double>::infinity());
    const double origin = packed.origin[static_cast<Eigen::Index>(axis)];
    packed.leaf_boxes.lo[axis][leaf] = rounded_down(lowest - origin);
    packed.leaf_boxes.hi[axis][leaf] = rounded_up(highest - origin);
  }
}

}  // namespace

void Boxes::resize(std::size_t count) {
  constexpr std::size_t kPadding = 8;
  size = count;
  const std::size_t padded = (count + kPadding - 1) / kPadding * kPadding;
  for (auto* bounds : {&lo, &hi}) {
    for (std::vector<float>& bound : *bounds) bound.assign(padded, std::numeric_limits<float>::infinity());
  }
}

PackedPoints::PackedPoints(PointsView points, std::vector<std::uint32_t> order, const Eigen::Vector3d& boxes_origin,
                           const Execution& execution)
    : num_points(points.size()), origin(boxes_origin), original_index(std::move(order)) {
  constexpr std::size_t kLeavesPerBlock = 1U << 10U;
  const std::size_t count = (num_points + kLeafSize - 1) / kLeafSize;
  coordinates.resize(3 * kLeafSize * count);
  leaf_boxes.resize(count);
  for_each_block(count, kLeavesPerBlock, {.num_threads = execution.num_threads}, "", [&](const Block& block) {
    for (std::size_t leaf = block.begin; leaf < block.end; ++leaf) fill_leaf(points, leaf, *this);
  });
}

}  // namespace trysquare
