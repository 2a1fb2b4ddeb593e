// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/points.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace trysquare {

/// The cube that a Hilbert curve fills.
struct HilbertCube {
  Eigen::Vector3d lowest = Eigen::Vector3d::Zero();  ///< [m]
  double edge_m = 0;                                 ///< >= 0.

  /// A whole number near its middle, so that small offsets from it add up exactly.
  Eigen::Vector3d origin() const { return (lowest + Eigen::Vector3d::Constant(edge_m / 2)).array().floor(); }
};

/// The smallest cube around the middle of the points' box that holds all points.
HilbertCube hilbert_cube_around(PointsView points);

/// The order of the points along the Hilbert curve: points that follow each other are near each other. Points outside
/// the cube count as if they lay on its border. Points in one cell keep the order in which they came; for N points on
/// surfaces a side of the cube has about 4√N cells, so that in the mean a cell that is not empty holds few.
///
/// @return  N indices into `points`.
/// Source: J. Skilling, Programming the Hilbert curve, AIP Conf. Proc. 707 (2004); Morton order tests 24 % more points.
/// Cost: O(N); 24 bytes a point while it runs.
std::vector<std::uint32_t> hilbert_order(PointsView points, const HilbertCube& cube, const Execution& execution);

}  // namespace trysquare
