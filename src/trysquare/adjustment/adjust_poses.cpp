// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/adjust_poses.h"

#include "trysquare/adjustment/patch_observations.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace trysquare {
namespace {

constexpr std::size_t kFewestIterations = 3;  ///< A single step is 1 to 5 % short.
constexpr double kNarrowing = 0.6;
constexpr std::size_t kPosesPerStretch = 30;
constexpr double kStepsInHeight = 5;  ///< Cylinders as high as this many of the last steps lose no surface.

/// The poses [begin, end), and what they all do in a step.
struct Stretch {
  std::size_t begin = 0;
  std::size_t end = 0;
  Eigen::Vector3d center_in_map = Eigen::Vector3d::Zero();
  PoseError shared;  ///< Mean turn, and mean translation at the center.
};

Stretch stretch_of(std::size_t begin, std::size_t end, const std::vector<PoseError>& step,
                   const std::vector<Eigen::Vector3d>& positions_in_map) {
  Stretch result{.begin = begin, .end = end};
  const auto n = static_cast<double>(end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    result.center_in_map += positions_in_map[i] / n;
    result.shared.translation_m += step[i].translation_m / n;
    result.shared.rotation_rad += step[i].rotation_rad / n;
  }
  return result;
}

/// Root mean square of what the poses move beyond the motion that each stretch of them shares: translation, rotation.
/// A long drive bends by millimetres with every point that enters or leaves a cylinder, and does not stop.
std::pair<double, double> rms_within_stretches(const std::vector<PoseError>& step,
                                               const std::vector<Eigen::Vector3d>& positions_in_map) {
  const std::size_t num_poses = step.size();
  const std::size_t num_stretches = (num_poses + kPosesPerStretch - 1) / kPosesPerStretch;
  double translation = 0;
  double rotation = 0;
  for (std::size_t k = 0; k < num_stretches; ++k) {
    const Stretch stretch =
        stretch_of(k * num_poses / num_stretches, (k + 1) * num_poses / num_stretches, step, positions_in_map);
    for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
      const Eigen::Vector3d turned = stretch.shared.rotation_rad.cross(positions_in_map[i] - stretch.center_in_map);
      translation += (step[i].translation_m - stretch.shared.translation_m - turned).squaredNorm();
      rotation += (step[i].rotation_rad - stretch.shared.rotation_rad).squaredNorm();
    }
  }
  return {std::sqrt(translation / static_cast<double>(num_poses)),
          std::sqrt(rotation / static_cast<double>(num_poses))};
}

/// Moves all poses together so that the first is `first`.
void move_to(const Pose& first, std::vector<Pose>& poses) {
  const Pose motion = first * general_inverse(poses.front());
  for (Pose& pose : poses) pose = motion * pose;
  poses.front() = first;
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
    result.observed_from = positions_of(result.map_from_scan);
    result.errors = solve_pose_errors(result.observed, result.observed_from, execution);
    for (std::size_t i = 0; i < result.map_from_scan.size(); ++i) {
      result.map_from_scan[i] = without_error(result.map_from_scan[i], result.errors.of_pose[i]);
    }
    std::tie(result.last_step_m, result.last_step_rad) =
        rms_within_stretches(result.errors.of_pose, result.observed_from);
    ++result.num_iterations;
    result.converged = is_narrowest && result.num_iterations >= kFewestIterations &&
                       result.last_step_m <= kConvergedStep_m && result.last_step_rad <= kConvergedStep_rad;
    const bool is_near = kStepsInHeight * result.last_step_m <= narrowest_m;
    half_height_m = is_near ? narrowest_m : std::max(narrowest_m, kNarrowing * half_height_m);
  }
  move_to(map_from_scan.front(), result.map_from_scan);
  return result;
}

}  // namespace trysquare
