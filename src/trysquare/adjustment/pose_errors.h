// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/patch_observations.h"
#include "trysquare/core/execution.h"
#include "trysquare/core/pose.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace trysquare {

/// By how much a pose is off, in the map frame: the scan stands at t + translation and is turned by exp(rotation) about
/// its sensor.
struct PoseError {
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  ///< Rotation vector.
};

/// How well pose errors are known: a sandwich estimate, in which all patches of one block of space may err together.
struct PoseErrorCovariance {
  std::vector<Eigen::Matrix<double, 6, 6>> of_pose;  ///< Of (translation, rotation); zero for pose 0, which is fixed.
  double mean_pair_translation_m2 = 0;  ///< Mean over all pairs of poses of trace Cov(e_i − e_j).
  double mean_pair_rotation_rad2 = 0;   ///< The same of the rotations.
  std::size_t num_blocks = 0;           ///< Blocks that it was estimated from.
};

/// Pose errors that explain the observations best.
struct PoseErrors {
  std::vector<PoseError> of_pose;  ///< N errors relative to pose 0, whose own is zero.
  std::vector<std::vector<double>> weights;  ///< Robust weight of every observation of every patch, in [0, 1].
  double residual_scale = 0;  ///< Spread of the residuals over their predicted standard deviations.
  PoseErrorCovariance covariance;
};

/// Robust least squares over all poses: a_pi = h_p + n_p · (e_i + ω_i × (q_p − c_i)) + noise, with the heights h_p of
/// the patches eliminated and pose 0 held. Weights by Huber, then by Tukey; scale from the median absolute residual.
///
/// @param positions_in_map  N sensor positions c_i [m].
/// @param block_m           Edge of the blocks of the covariance [m]. 0: no covariance is computed.
/// @return                  Poses that nothing observes have the error zero: look at the weights.
///
/// Source: docs/definitions.md#rpe-estimate (step 5). Eigen's sparse LDLᵀ: memory and time follow which scans share
/// patches; a long drive is banded.
PoseErrors solve_pose_errors(std::span<const ObservedPatch> patches, std::span<const Eigen::Vector3d> positions_in_map,
                             double block_m, const Execution& execution = {});

/// The pose without its error.
Pose without_error(const Pose& map_from_scan, const PoseError& error);

/// The error that turns `corrected` into `given`: the inverse of without_error().
PoseError error_between(const Pose& given, const Pose& corrected);

}  // namespace trysquare
