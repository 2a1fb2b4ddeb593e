// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/adjust_poses.h"
#include "trysquare/adjustment/rpe_estimate.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace trysquare::internal {

/// Two scans that share this many inlier patches hold each other.
inline constexpr std::size_t kFewestSharedPatches = 30;

/// Of the eigenvalue of a tie: share of the smallest eigenvalue of the normals, which is that of the tie where all
/// poses see the same planes. Poses cannot be tied better.
inline constexpr double kLeastTie = 0.125;

/// What the inlier observations of an adjustment say about how well it is determined.
struct Agreement {
  std::vector<std::size_t> observations_of_pose;
  std::size_t num_inliers = 0;
  std::size_t observations_per_pose_min = 0;
  std::size_t least_observed_pose = 0;
  double least_share_of_neighbors = 0;  ///< Smallest count of a pose over the median count of the poses around it.
  std::size_t least_agreeing_pose = 0;  ///< Whose that is.
  std::size_t num_components = 0;       ///< Groups of scans connected by kFewestSharedPatches.
  double smallest_eigenvalue = 0;       ///< Of the mean n nᵀ of the inlier observations; 0 without any.
  Eigen::Vector3d weakest_direction_in_map = Eigen::Vector3d::Zero();
  std::optional<PoseTie> weakest_tie;  ///< Of the runs of poses in a row; empty without any inlier.
  double within_scan_sigma_m = 0;      ///< Median over the observed patches.
};

Agreement agreement_of(const AdjustedPoses& adjusted, std::size_t num_poses);

}  // namespace trysquare::internal
