// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/adjustment_settings.h"
#include "trysquare/adjustment/indexed_scans.h"
#include "trysquare/core/execution.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace trysquare {

/// A piece of a flat surface, in the frame of the scan that it was found in: it moves along with that scan's pose.
struct PlanePatch {
  std::uint32_t scan = 0;                                   ///< The scan that found it.
  Eigen::Vector3d center_in_scan = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d normal_in_scan = Eigen::Vector3d::Zero();  ///< Unit; its sign means nothing.
};

/// Planar patches of some scans, evenly spread over the sequence: in each, one per voxel, the flattest. They do not depend
/// on poses, so two trajectories of the same scans are judged by the same patches.
///
/// @param settings  `scans_per_source` and what stands under "Patches".
/// @return          At most max_patches_per_source times the scans looked at, thinned out evenly; in a fixed order.
/// Source: docs/definitions.md#rpe-estimate (step 1); planar_patches().
std::vector<PlanePatch> find_plane_patches(const IndexedScans& scans, const AdjustmentSettings& settings,
                                           const Execution& execution = {});

}  // namespace trysquare
