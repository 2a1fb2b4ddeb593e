// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/points.h"
#include "trysquare/neighborhood/internal/hilbert_order.h"

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace trysquare {

/// Axis-aligned boxes, one array a bound. Single precision, rounded outwards: a box holds its points, always. Padded to
/// a multiple of 8 with infinity: far from everything.
struct Boxes {
  std::array<std::vector<float>, 3> lo;
  std::array<std::vector<float>, 3> hi;

  std::size_t size = 0;

  void resize(std::size_t count);
};

/// Single precision that is certainly not above, or not below, the value.
inline float rounded_down(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest - std::abs(nearest) * 0x1p-23F - std::numeric_limits<float>::min();
}
inline float rounded_up(double value) { return -rounded_down(-value); }

/// Points in an order in which neighbors follow each other, cut into leaves of 16 consecutive ones.
struct PackedPoints {
  static constexpr std::size_t kLeafSize = 16;

  std::size_t num_points = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< Boxes are about this point.
  std::vector<double> coordinates;  ///< The original doubles: of every leaf 16 x, 16 y, 16 z; padded with infinity.
  std::vector<std::uint32_t> original_index;  ///< Empty: they are in their own order.
  Boxes leaf_boxes;

  /// @param order   N indices into `points`; empty: as they come.
  /// @param origin  About which the boxes are stored: near the points, or they lose digits.
  PackedPoints(PointsView points, std::vector<std::uint32_t> order, const Eigen::Vector3d& origin,
               const Execution& execution);

  std::size_t num_leaves() const { return leaf_boxes.size; }
  std::size_t points_in_leaf(std::size_t leaf) const {
    return leaf + 1 < num_leaves() ? kLeafSize : num_points - leaf * kLeafSize;
  }
  /// 16 coordinates along one axis.
  const double* leaf_axis(std::size_t leaf, std::size_t axis) const {
    return coordinates.data() + (3 * leaf + axis) * kLeafSize;
  }
  Eigen::Vector3d point(std::size_t packed_index) const {
    const std::size_t leaf = packed_index / kLeafSize;
    const std::size_t i = packed_index % kLeafSize;
    return {leaf_axis(leaf, 0)[i], leaf_axis(leaf, 1)[i], leaf_axis(leaf, 2)[i]};
  }
};

}  // namespace trysquare
