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
  if (relation == PoseRelation::kPointDistance || relation == PoseRelation::kPointDistanceErrorRatio) {
    const double expected_m = (ref_i.translation - ref_j.translation).norm();
    const double error_m = std::abs(expected_m - (est_i.translation - est_j.translation).norm());
    return relation == PoseRelation::kPointDistance ? error_m : error_m / expected_m * 100;
  }
  using internal::relative_pose;
  return internal::magnitude(relative_pose(relative_pose(ref_i, ref_j), relative_pose(est_i, est_j)), relation);
}

/// Pairs that the reference does not move between have no ratio.
void leave_out_zero_distances(TrajectoryErrors& result, const Trajectory& reference, const RpeSettings& settings) {
  if (settings.relation != PoseRelation::kPointDistanceErrorRatio) return;
  result.num_zero_distances = std::erase_if(result.pairs, [&](const PosePair& pair) {
    return reference.world_from_scan[pair.first].translation == reference.world_from_scan[pair.second].translation;
  });
  if (result.pairs.empty()) {
    throw InvalidArgument(
        fmt::format("in all {} pairs the reference stands still: the ratio is undefined", result.num_zero_distances));
  }
}

}  // namespace

TrajectoryErrors rpe(const Trajectory& reference, const Trajectory& estimate, const RpeSettings& settings) {
  internal::validate_poses(reference, estimate);
  TrajectoryErrors result{.relation = settings.relation, .unit = unit_of(settings.relation)};
  result.reference_from_estimate = align(reference, estimate, settings.alignment, settings.num_poses_to_align);
  Trajectory aligned = transformed(result.reference_from_estimate, estimate);
  if (settings.projection) aligned = projected(aligned, *settings.projection);
  const Trajectory truth = settings.projection ? projected(reference, *settings.projection) : reference;
  result.pairs = pose_pairs(settings.pairs_from_reference ? truth : aligned, settings.pairs);
  if (result.pairs.empty()) {
    throw InvalidArgument(
        fmt::format("delta = {} {} matches no pair of the {} poses: take a smaller delta or a larger tolerance",
                    settings.pairs.delta, name_of(settings.pairs.unit), reference.size()));
  }
  leave_out_zero_distances(result, truth, settings);
  result.errors.reserve(result.pairs.size());
  for (const PosePair& pair : result.pairs) {
    result.errors.push_back(relative_error(truth, aligned, pair, settings.relation));
  }
  result.statistics = error_statistics(result.errors);
  return result;
}

}  // namespace trysquare
