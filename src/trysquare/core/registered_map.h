// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/pose.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trysquare {

/// All scans of a sequence in one frame: the paper's P. The map frame is the frame of the first scan, so coordinates
/// stay small wherever on Earth the world frame has its origin.
struct RegisteredMap {
  std::vector<Eigen::Vector3d> points_in_map;  ///< N points [m], in scan order.
  std::vector<std::uint32_t> scan_of_point;    ///< N indices < num_scans.
  std::size_t num_scans = 0;
  Pose world_from_map;  ///< Pose of the first scan.
};

}  // namespace trysquare
