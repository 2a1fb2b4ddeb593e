// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/rpe.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/internal/pose_error.h"
#include "trysquare/trajectory/internal/validate.h"

#include <fmt/format.h>

#include <cmath>

namespace trysquare {
namespace {

double relative_error(const Trajectory& reference, const Trajectory& estimate, const PosePair& pair,
                      PoseRelation relation) {
  const Pose& ref_i = reference.world_from_scan[pair.first];
  const Pose& ref_j = reference.world_from_scan[pair.second];
  const Pose& est_i = estimate.world_from_scan[pair.first];
  const Pose& est_j = estimate.world_from_scan[pair.second];
  if (relation == PoseRelation::kPointDistance) {
    return std::abs((ref_i.translation - ref_j.translation).norm() - (est_i.translation - est_j.translation).norm());
  }
  using internal::relative_pose;
  return internal::magnitude(relative_pose(relative_pose(ref_i, ref_j), relative_pose(est_i, est_j)), relation);
}

}  // namespace

TrajectoryErrors rpe(const Trajectory& reference, const Trajectory& estimate, const RpeSettings& settings) {
  internal::validate_poses(reference, estimate);
  TrajectoryErrors result{.relation = settings.relation};
  result.reference_from_estimate = align(reference, estimate, settings.alignment, settings.num_poses_to_align);
  const Trajectory aligned = transformed(result.reference_from_estimate, estimate);
  result.pairs = pose_pairs(settings.pairs_from_reference ? reference : aligned, settings.pairs);
  if (result.pairs.empty()) {
    throw InvalidArgument(
        fmt::format("delta = {} {} matches no pair of the {} poses: take a smaller delta or a larger tolerance",
                    settings.pairs.delta, name_of(settings.pairs.unit), reference.size()));
  }
  result.errors.reserve(result.pairs.size());
  for (const PosePair& pair : result.pairs) {
    result.errors.push_back(relative_error(reference, aligned, pair, settings.relation));
  }
  result.statistics = error_statistics(result.errors);
  return result;
}

}  // namespace trysquare
