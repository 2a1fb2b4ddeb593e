// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/pose.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace trysquare {

/// Points lying on mutually orthogonal surfaces, grouped by direction. Paper §IV-B.
struct OrthogonalSubset {
  struct Direction {
    Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();  ///< Unit length, sign arbitrary; zero when not known.
    std::vector<Eigen::Vector3d> points_in_map;               ///< [m]
  };
  std::vector<Direction> directions;  ///< 0 to 3; fewer than 3 is the degenerate case of §IV-C.

  std::size_t num_points() const {
    std::size_t count = 0;
    for (const Direction& direction : directions) count += direction.points_in_map.size();
    return count;
  }
};

/// The same subset in another frame.
OrthogonalSubset transformed(const Pose& b_from_a, OrthogonalSubset subset_in_a);

}  // namespace trysquare
