// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/paper_rpe.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/internal/validate.h"

#include <vector>

namespace trysquare {
namespace {

/// The part of E_ij that does not depend on j, so that one of the N² terms costs two 3×3 products.
struct FirstPose {
  Eigen::Matrix3d ref_i_est_i;  ///< R_i S_iᵀ; R, r: rotation and position of the reference, S, s: of the estimate.
  Eigen::Matrix3d ref_i_ref_i;  ///< R_i R_iᵀ, which is not the identity in files of six digits.
};

/// Σ over j ≠ i of ‖(R_iᵀ R_j)ᵀ (S_iᵀ (s_j − s_i) − R_iᵀ (r_j − r_i))‖².
double sum_over_second_pose(const Trajectory& reference, const Trajectory& estimate, std::size_t i) {
  const Pose& ref_i = reference.world_from_scan[i];
  const Pose& est_i = estimate.world_from_scan[i];
  const FirstPose first{ref_i.rotation * est_i.rotation.transpose(), ref_i.rotation * ref_i.rotation.transpose()};
  double sum = 0;
  for (std::size_t j = 0; j < reference.size(); ++j) {
    if (j == i) continue;
    const Pose& ref_j = reference.world_from_scan[j];
    const Eigen::Vector3d estimated = first.ref_i_est_i * (estimate.world_from_scan[j].translation - est_i.translation);
    const Eigen::Vector3d expected = first.ref_i_ref_i * (ref_j.translation - ref_i.translation);
    sum += (ref_j.rotation.transpose() * (estimated - expected)).squaredNorm();
  }
  return sum;
}

}  // namespace

double paper_rpe(const Trajectory& reference, const Trajectory& estimate) {
  internal::validate_poses(reference, estimate);
  if (reference.size() < 2) throw InvalidArgument("the paper's RPE needs at least two poses, there is one");
  double sum = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) sum += sum_over_second_pose(reference, estimate, i);
  return sum / static_cast<double>(reference.size());
}

}  // namespace trysquare
