// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/ape.h"

#include "trysquare/core/error.h"
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
  if (settings.relation == PoseRelation::kPointDistanceErrorRatio) {
    throw InvalidArgument("relation = point_distance_error_ratio: absolute errors have no such ratio");
  }
  TrajectoryErrors result{.relation = settings.relation, .unit = unit_of(settings.relation)};
  result.reference_from_estimate = align(reference, estimate, settings.alignment, settings.num_poses_to_align);
  Trajectory aligned = transformed(result.reference_from_estimate, estimate);
  if (settings.projection) aligned = projected(aligned, *settings.projection);
  const Trajectory truth = settings.projection ? projected(reference, *settings.projection) : reference;
  result.errors.reserve(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    result.errors.push_back(absolute_error(truth.world_from_scan[i], aligned.world_from_scan[i], settings.relation));
  }
  result.statistics = error_statistics(result.errors);
  return result;
}

}  // namespace trysquare
