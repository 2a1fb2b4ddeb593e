// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/adjustment_settings.h"
#include "trysquare/adjustment/indexed_scans.h"
#include "trysquare/adjustment/plane_patches.h"
#include "trysquare/adjustment/pose_errors.h"
#include "trysquare/core/execution.h"
#include "trysquare/core/pose.h"

#include <cstddef>
#include <span>
#include <vector>

namespace trysquare {

/// A last step up to here is convergence ...
inline constexpr double kConvergedStep_m = 0.003;
/// ... if its rotation is up to here: 0.05 degrees.
inline constexpr double kConvergedStep_rad = 0.05 * 3.14159265358979323846 / 180;

/// The poses in which the scans agree on their planar patches, and how they were found.
struct AdjustedPoses {
  std::vector<Pose> map_from_scan;  ///< Pose 0 as given.
  std::size_t num_iterations = 0;
  double last_step_m = 0;  ///< Root mean square of the last step, beyond what each 30 poses in a row share of it.
  double last_step_rad = 0;
  bool converged = false;                      ///< The last step was at most kConvergedStep_m and kConvergedStep_rad.
  std::vector<ObservedPatch> observed;         ///< What the last step saw ...
  std::vector<Eigen::Vector3d> observed_from;  ///< ... and from which sensor positions.
  PoseErrors errors;                           ///< Of the last step.
};

/// Plane adjustment: observes the patches, solves for the pose errors, corrects the poses, and again, in cylinders that
/// get lower as the poses get better, until a step is small.
///
/// @param map_from_scan  N poses to start from, N >= 2: within about a metre of where the planes agree.
/// @return               Not converged after max_iterations is a result, not an error.
/// Source: docs/definitions.md#rpe-estimate (step 5).
AdjustedPoses adjust_poses(std::span<const PlanePatch> patches, const IndexedScans& scans,
                           std::span<const Pose> map_from_scan, const AdjustmentSettings& settings,
                           const Execution& execution = {});

}  // namespace trysquare
