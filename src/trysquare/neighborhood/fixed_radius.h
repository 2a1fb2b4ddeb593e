// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/neighborhood/moments.h"
#include "trysquare/neighborhood/point_index.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace trysquare {

/// All points with d < radius_m (strictly) from the center.
struct Ball {
  Eigen::Vector3d center_in_map = Eigen::Vector3d::Zero();  ///< [m]
  double radius_m = 1.0;
};

/// All points nearer than radius_m to an axis through the center, and at most half_height_m along it from the center: a
/// patch of a plane whose normal is the axis.
struct Cylinder {
  Eigen::Vector3d center_in_map = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();          ///< Of unit length.
  double radius_m = 1.0;
  double half_height_m = 1.0;
};

/// What one scan has in a region.
struct ScanMoments {
  std::uint32_t scan = 0;
  Moments moments;  ///< mean_from_query is the mean minus the region's center; num_scans is 1.
};

/// The moments of the points in a region, scan by scan, in ascending order of the scans; scans without points there are
/// left out. A map without scan identity counts as one scan, number 0.
///
/// @throws InvalidArgument  if a radius or height is not positive and finite, the center is not finite, or the axis is
///                          not of unit length within 1e-6.
///
/// Accuracy: two passes; |Δλ₁| <= 1e-14 λ₃. Cost: O(log N + points in the region).
std::vector<ScanMoments> moments_by_scan(const PointIndex& map, const Ball& region);
std::vector<ScanMoments> moments_by_scan(const PointIndex& map, const Cylinder& region);

}  // namespace trysquare
