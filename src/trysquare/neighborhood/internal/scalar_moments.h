// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/neighborhood/internal/packed_tree.h"
#include "trysquare/neighborhood/internal/scan_counter.h"
#include "trysquare/neighborhood/moments.h"

#include <Eigen/Core>

#include <vector>

namespace trysquare {

/// Moments of points that are given relative to the query; the second pass is centered on the mean, so nothing cancels.
Moments moments_in_two_passes(const std::vector<Eigen::Vector3d>& from_query);

/// The moments of one neighborhood the plain way: every point is tested, and there are two passes. The oracle of the
/// kernels, and their refuge where one pass is not accurate enough.
class ScalarMoments {
 public:
  explicit ScalarMoments(const PointIndex::Tree& tree) : tree_(tree), scans_(tree.has_scans() ? tree.num_scans : 0) {}

  Moments around(const Eigen::Vector3d& query, double radius_m);

 private:
  const PointIndex::Tree& tree_;
  ScanCounter scans_;
  std::vector<Eigen::Vector3d> from_query_;
};

}  // namespace trysquare
