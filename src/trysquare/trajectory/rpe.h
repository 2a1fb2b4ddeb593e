// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/trajectory/alignment.h"
#include "trysquare/trajectory/pose_pairs.h"
#include "trysquare/trajectory/pose_relation.h"
#include "trysquare/trajectory/projection.h"
#include "trysquare/trajectory/trajectory_errors.h"

#include <cstddef>
#include <optional>

namespace trysquare {

/// Defaults are evo's.
struct RpeSettings {
  PoseRelation relation = PoseRelation::kTranslationPart;
  PosePairSettings pairs{};
  bool pairs_from_reference = false;  ///< Path and angle of the pairs are measured on the reference, not the estimate.
  Alignment alignment = Alignment::kNone;
  std::size_t num_poses_to_align = 0;  ///< As in align(); 0: all.
  std::optional<Plane> projection{};   ///< Both are projected after the alignment.
};

/// Relative pose error (RPE): how much the motion from pose i to pose j differs between estimate and reference.
/// Lower is better, 0 means equal motions. Local: it measures drift, wherever the run starts.
///
/// E_ij = (ref_i⁻¹ ref_j)⁻¹ (est_i⁻¹ est_j), rigid inverses, raw matrices; kPointDistance: the difference of the two
/// distances ‖p_i − p_j‖; kPointDistanceErrorRatio: that over the one of the reference, without the pairs where it is
/// 0.
///
/// @param reference, estimate   Any world frames, sensor frames equal; pose i belongs to pose i (see associate()).
/// @return                      One error per pair.
/// @throws InvalidArgument  if the counts differ or are 0, a pose is not finite, the settings are out of range, the
///                          positions do not fix the alignment, or no pair is `delta` apart.
///
/// Properties (rpe_test.cpp), up to rounding:
///   (1) invariant under a rigid motion of either world
///
/// Accuracy: evo 1.36 to 1e-9 relative, 1e-12 absolute (tests/oracle/trajectory_oracle_test.cpp).
/// Source:   Sturm et al., A Benchmark for the Evaluation of RGB-D SLAM Systems, 2012; evo.
/// Differs:  the paper writes T_i T_j⁻¹, which depends on the origin of the world (docs/definitions.md#rpe).
/// Cost:     of pose_pairs(), and O(1) per pair.
TrajectoryErrors rpe(const Trajectory& reference, const Trajectory& estimate, const RpeSettings& settings = {});

}  // namespace trysquare
