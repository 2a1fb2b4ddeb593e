// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/adjust_poses.h"

#include "trysquare/adjustment/patch_observations.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace trysquare {
namespace {

constexpr std::size_t kFewestIterations = 3;  ///< A single step is 1 to 5 % short.
constexpr double kNarrowing = 0.6;
constexpr double kStepsInHeight = 5;  ///< Cylinders as high as this many of the last steps lose no surface.

/// Root mean square of the errors' lengths: translation, rotation.
std::pair<double, double> rms_of(const std::vector<PoseError>& errors) {
  double translation = 0;
  double rotation = 0;
  for (const PoseError& error : errors) {
    translation += error.translation_m.squaredNorm();
    rotation += error.rotation_rad.squaredNorm();
  }
  const auto n = static_cast<double>(errors.size());
  return {std::sqrt(translation / n), std::sqrt(rotation / n)};
}

std::vector<Eigen::Vector3d> positions_of(const std::vector<Pose>& poses) {
  std::vector<Eigen::Vector3d> positions;
  for (const Pose& pose : poses) positions.push_back(pose.translation);
  return positions;
}

}  // namespace

AdjustedPoses adjust_poses(std::span<const PlanePatch> patches, const IndexedScans& scans,
                           std::span<const Pose> map_from_scan, const AdjustmentSettings& settings,
                           const Execution& execution) {
  AdjustedPoses result{.map_from_scan = {map_from_scan.begin(), map_from_scan.end()}};
  const double narrowest_m = settings.narrowest_half_height_m;
  double half_height_m = settings.widest_half_height_m;
  while (result.num_iterations < settings.max_iterations && !result.converged) {
    const bool is_narrowest = half_height_m <= narrowest_m;
    result.observed = observe_patches(patches, scans, result.map_from_scan, half_height_m, settings, execution);
    result.errors =
        solve_pose_errors(result.observed, positions_of(result.map_from_scan), settings.covariance_block_m, execution);
    for (std::size_t i = 0; i < result.map_from_scan.size(); ++i) {
      result.map_from_scan[i] = without_error(result.map_from_scan[i], result.errors.of_pose[i]);
    }
    std::tie(result.last_step_m, result.last_step_rad) = rms_of(result.errors.of_pose);
    ++result.num_iterations;
    result.converged = is_narrowest && result.num_iterations >= kFewestIterations &&
                       result.last_step_m <= kConvergedStep_m && result.last_step_rad <= kConvergedStep_rad;
    const bool is_near = kStepsInHeight * result.last_step_m <= narrowest_m;
    half_height_m = is_near ? narrowest_m : std::max(narrowest_m, kNarrowing * half_height_m);
  }
  return result;
}

}  // namespace trysquare
