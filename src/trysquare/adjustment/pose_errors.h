// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/patch_observations.h"
#include "trysquare/core/execution.h"
#include "trysquare/core/pose.h"
#include "trysquare/trajectory/pose_pairs.h"

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

/// Pose errors that explain the observations best.
struct PoseErrors {
  std::vector<PoseError> of_pose;            ///< N errors, beyond a motion that all poses share.
  std::vector<std::vector<double>> weights;  ///< Robust weight of every observation of every patch, in [0, 1].
  double residual_scale = 0;                 ///< Spread of the residuals over their predicted standard deviations.
};

/// Robust least squares over all poses: a_pi = h_p + n_p · (e_i + ω_i × (q_p − c_i)) + noise, with the heights h_p of
/// the patches eliminated. Weights by Huber, then by Tukey; scale from the median absolute residual. Scans say nothing
/// of a motion that all poses share: of all solutions this is the one that moves the poses least. Were pose 0 held
/// instead, its own error, however small, would turn a long drive by metres at its end.
///
/// @param positions_in_map  N >= 2 sensor positions c_i [m].
/// @return                  Poses that nothing observes have the error zero: look at the weights.
/// @throws InvalidArgument  if there are fewer than two poses.
///
/// Source: docs/definitions.md#rpe-estimate (step 5).
/// Cost:   Eigen's sparse LDLᵀ: memory and time follow which scans share patches; a long drive is banded.
PoseErrors solve_pose_errors(std::span<const ObservedPatch> patches, std::span<const Eigen::Vector3d> positions_in_map,
                             const Execution& execution = {});

/// The part of the mean squared error of some pairs of poses that the estimate's own uncertainty makes.
struct PairVariance {
  double translation_m2 = 0;  ///< Mean over the pairs of trace Cov(e_i − e_j).
  double rotation_rad2 = 0;   ///< The same of the rotations.
};

/// The errors as seen from pose 0: less the shared motion that leaves pose 0 without an error.
///
/// @param errors            N errors.
/// @param positions_in_map  N sensor positions [m].
std::vector<PoseError> relative_to_first(std::span<const PoseError> errors,
                                         std::span<const Eigen::Vector3d> positions_in_map);

/// How well pose errors are known.
struct PoseErrorCovariance {
  std::vector<Eigen::Matrix<double, 6, 6>> of_pose;  ///< Of (translation, rotation) relative to pose 0; its own: zero.
  PairVariance all_pairs;                            ///< Over all pairs of poses.
  std::vector<PairVariance> of_pairs;                ///< Over each of the sets of pairs asked for.
  std::size_t num_blocks = 0;                        ///< Blocks of space that it was estimated from.
};

/// A sandwich estimate in which all patches of one block of space may err together, as those of one wall do.
///
/// @param errors     Of solve_pose_errors(), same patches and positions.
/// @param block_m    Edge of the blocks, > 0 [m].
/// @param pair_sets  Sets of pairs of poses to average over, none of them empty.
/// @return           Zero without two blocks: look at num_blocks.
PoseErrorCovariance pose_error_covariance(std::span<const ObservedPatch> patches,
                                          std::span<const Eigen::Vector3d> positions_in_map, const PoseErrors& errors,
                                          double block_m, std::span<const std::vector<PosePair>> pair_sets = {},
                                          const Execution& execution = {});

/// The pose without its error.
Pose without_error(const Pose& map_from_scan, const PoseError& error);

/// The error that turns `corrected` into `given`: the inverse of without_error().
PoseError error_between(const Pose& given, const Pose& corrected);

}  // namespace trysquare
