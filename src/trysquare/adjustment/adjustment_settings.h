// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>

namespace trysquare {

/// How trajectory errors are estimated from planar patches. Defaults are for a LiDAR outdoors; `room_scale()` has those
/// for a depth camera. Source of the numbers: docs/definitions.md#rpe-estimate.
struct AdjustmentSettings {
  // Patches.
  double patch_radius_m = 0.6;       ///< Of the disc that is one patch; > 0.
  double patch_spacing_m = 1.0;      ///< Edge of the voxels of a scan that hold at most one patch; > 0.
  double max_thickness_m = 0.08;     ///< sqrt(λ₁) of a patch within its scan is below; > 0.
  double planarity_ratio = 10;       ///< Flat: planarity_ratio · λ₁ < λ₂; > 0.
  double min_patch_range_m = 2;      ///< Patches are taken from points at least this far from the sensor, >= 0 ...
  double max_patch_range_m = 40;     ///< ... and at most this far; > min_patch_range_m.
  std::size_t scans_per_source = 6;  ///< One scan in this many offers patches, and five at least; >= 1.
  std::size_t max_patches_per_source = 300;  ///< On average over the scans that offer patches; >= 1.

  // Observations of patches by scans.
  double max_observation_range_m = 60;  ///< A scan farther away from a patch does not observe it; > 0.
  std::size_t max_observers = 120;      ///< Scans that observe one patch; more are thinned out evenly; >= 3.

  // Iterations.
  double widest_half_height_m = 1.0;     ///< Half height of the patches' cylinders at first: how far off a pose may be.
  double narrowest_half_height_m = 0.2;  ///< ... and at last; > 0, <= the widest.
  std::size_t max_iterations = 12;       ///< >= 2.

  // Blocks of space for the two halves of the patches (checkerboard) and for the covariance.
  double checkerboard_m = 3;      ///< Edge of one field; > 0.
  double covariance_block_m = 6;  ///< Patches within one block may share an error; > 0.

  // Points and memory.
  double min_range_m = 0;                                        ///< Points nearer to the sensor are dropped.
  double max_range_m = std::numeric_limits<double>::infinity();  ///< Points farther away are dropped.
  std::size_t max_points_in_memory = 16'000'000;  ///< With more points scans are loaded again in every iteration.

  /// The same for rooms seen by a depth camera: lengths a fifth, points from 0.2 m to 8 m.
  static AdjustmentSettings room_scale();

  void validate() const;  ///< @throws InvalidArgument
};

}  // namespace trysquare
