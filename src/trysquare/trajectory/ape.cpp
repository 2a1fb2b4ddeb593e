// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/ape.h"

#include "trysquare/trajectory/internal/pose_error.h"
#include "trysquare/trajectory/internal/validate.h"

namespace trysquare {
namespace {

double absolute_error(const Pose& reference, const Pose& estimate, PoseRelation relation) {
  if (relation == PoseRelation::kTranslationPart || relation == PoseRelation::kPointDistance) {
    return (reference.translation - estimate.translation).norm();
  }
  return internal::magnitude(internal::relative_pose(estimate, reference), relation);
}

}  // namespace

TrajectoryErrors ape(const Trajectory& reference, const Trajectory& estimate, const ApeSettings& settings) {
  internal::validate_poses(reference, estimate);
  TrajectoryErrors result{.relation = settings.relation};
  result.reference_from_estimate = align(reference, estimate, settings.alignment, settings.num_poses_to_align);
  const Trajectory aligned = transformed(result.reference_from_estimate, estimate);
  result.errors.reserve(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    result.errors.push_back(
        absolute_error(reference.world_from_scan[i], aligned.world_from_scan[i], settings.relation));
  }
  result.statistics = error_statistics(result.errors);
  return result;
}

}  // namespace trysquare
