// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/patch_observations.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace trysquare {

/// The between-scan variance (BV) along one orthogonal direction.
struct DirectionVariance {
  Eigen::Vector3d axis_in_map = Eigen::Vector3d::Zero();  ///< Unit.
  std::size_t num_patches = 0;
  double variance_m2 = 0;  ///< Noise removed; can come out a little below 0 when the poses are perfect.
};

/// MOM without its noise floor and its assumption of balance: how far the scans are apart on orthogonal surfaces.
struct BetweenScanVariance {
  std::vector<DirectionVariance> directions;  ///< Up to three, most patches first.
  std::optional<double> mom_debiased_m;       ///< Root of the sum over the directions [m]; empty without three.
};

/// Per direction the mean over pairs of scans of the median over patches of (a_pi − a_pj)² − var_i − var_j.
///
/// Without rotation errors its sum over three directions is the squared translational RPE over all pairs; with them it is
/// nearer to it than MOM, but not equal: rpe_estimate.h solves for both.
///
/// @param patches  Observed from the given poses, before any correction.
/// Source: docs/definitions.md#rpe-estimate (step 4).
BetweenScanVariance between_scan_variance(std::span<const ObservedPatch> patches);

}  // namespace trysquare
