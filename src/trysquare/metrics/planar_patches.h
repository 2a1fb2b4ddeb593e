// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/registered_map.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trysquare {

/// What counts as a planar patch. Lengths are multiples of the one radius that the caller gives, so that the same
/// numbers serve a LiDAR outdoors (radius 1 m) and a depth camera indoors (0.2 m).
struct PlanarPatchSettings {
  std::size_t num_scans = 10;   ///< Scans, evenly spread, whose points are looked at; >= 1.
  double patch_radius = 0.6;    ///< Radius of a patch / radius_m; > 0.
  double spacing = 0.25;        ///< Edge of the voxels that hold at most one patch / radius_m; > 0.
  double planarity_ratio = 20;  ///< Flat: planarity_ratio · λ₁ < λ₂; > 0.
  double line_ratio = 0.05;     ///< Not a line, as a single ring of a LiDAR is: λ₂ > line_ratio · λ₃; in [0, 1).
  double max_thickness = 0.08;  ///< Thin: sqrt(λ₁) < max_thickness · radius_m; > 0.
  std::size_t min_points = 15;  ///< Of a patch; >= 4, since any three lie in a plane.

  void validate() const;  ///< @throws InvalidArgument
};

/// A piece of a flat surface, as one scan sees it.
struct PlanarPatch {
  Eigen::Vector3d center_in_map = Eigen::Vector3d::Zero();  ///< A point of the scan, to the bit [m].
  Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();  ///< Unit; its last component that is not 0 is positive.
  Eigen::Vector3d eigenvalues = Eigen::Vector3d::Zero();  ///< λ₁ <= λ₂ <= λ₃ of the patch's covariance [m²].
  std::uint32_t scan = 0;                                 ///< Whose points the patch is made of.
  std::uint32_t num_points = 0;                           ///< Of the scan, in the ball around the center.
};

/// Patches and what they were chosen from.
struct PlanarPatches {
  std::vector<PlanarPatch> patches;  ///< In the order of their voxels.
  std::size_t num_candidates = 0;    ///< Points looked at: one per voxel and scan.
  std::size_t num_planar = 0;        ///< Of these, on a planar patch.
};

/// Finds planar patches, evenly spread over the surfaces that some scans of a map see.
///
/// Every scan offers one candidate per voxel, the point nearest to its center. Normal and planarity come from one ball
/// around it within the same scan, so pose errors do not decide what counts as a plane. Over all scans the flattest
/// candidate of a voxel (smallest λ₁ / λ₂) stays: a surface counts by its area, not by how often it was seen or how
/// densely, and a good view of it replaces a bad one.
///
/// @param map        N points in scan order, map frame [m].
/// @param radius_m   The length that all settings are multiples of, > 0 [m].
/// @param execution  Threads. The result is bit-identical for every value, and for every order of the points of a scan.
/// @throws InvalidArgument  if `settings` or `radius_m` is out of range, a coordinate is not finite, or points and scan
///                          indices differ in number.
///
/// Cost: O(n log n) for the n points of the chosen scans; five scans of 120,000 points take about 0.3 s on one core.
PlanarPatches planar_patches(const RegisteredMap& map, double radius_m, const PlanarPatchSettings& settings = {},
                             const Execution& execution = {});

}  // namespace trysquare
