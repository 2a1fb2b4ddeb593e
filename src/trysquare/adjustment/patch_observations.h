// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/adjustment_settings.h"
#include "trysquare/adjustment/indexed_scans.h"
#include "trysquare/adjustment/plane_patches.h"
#include "trysquare/core/execution.h"
#include "trysquare/core/pose.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace trysquare {

/// Where one scan sees a patch along the patch's normal.
struct PatchObservation {
  std::uint32_t scan = 0;
  double intercept_m = 0;  ///< Offset of the scan's surface from the patch's center, free of tilt and point balance.
  double variance_m2 = 0;  ///< Of the intercept, from the noise within the scans; > 0.
};

/// A patch and the scans that see it.
struct ObservedPatch {
  Eigen::Vector3d center_in_map = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();  ///< Unit.
  double within_scan_sigma_m = 0;                           ///< Noise of points about the surface within a scan.
  std::vector<PatchObservation> observations;               ///< By scan, ascending: two or more, or none.
};

/// Looks at every patch from every scan that is near enough and not behind it: the back of a wall is another surface.
///
/// The points of a scan in a cylinder around the patch have a mean offset along its normal that depends on where on the
/// patch they lie when the patch is tilted. An analysis of covariance removes that: per patch one common slope in the
/// plane and one intercept per scan, so that the offset does not depend on rings, tilt or balance of the points.
///
/// @param map_from_scan  One pose per scan; patches move along with the scan that they were found in.
/// @param half_height_m  Of the cylinders along the normals, > 0: scans farther off are not seen. Nor are those behind
///                       a patch by more than this.
/// @return               One entry per patch, in their order; without observations where the slope is not determined
///                       or fewer than two scans have six points.
/// Source: docs/definitions.md#rpe-estimate (steps 2 and 3).
std::vector<ObservedPatch> observe_patches(std::span<const PlanePatch> patches, const IndexedScans& scans,
                                           std::span<const Pose> map_from_scan, double half_height_m,
                                           const AdjustmentSettings& settings, const Execution& execution = {});

}  // namespace trysquare
