// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/trajectory/alignment.h"
#include "trysquare/trajectory/pose_relation.h"
#include "trysquare/trajectory/projection.h"
#include "trysquare/trajectory/trajectory_errors.h"

#include <cstddef>
#include <optional>

namespace trysquare {

/// Defaults are evo's.
struct ApeSettings {
  PoseRelation relation = PoseRelation::kTranslationPart;
  Alignment alignment = Alignment::kNone;
  std::size_t num_poses_to_align = 0;  ///< As in align(); 0: all.
  std::optional<Plane> projection{};   ///< Both are projected after the alignment.
};

/// Absolute pose error (APE): how far each estimated pose is from the reference pose, after an alignment.
/// Lower is better, 0 means equal. Global: one wrong turn early in the run is paid for by every later pose.
///
/// The translation relations are ‖p_ref − p_est‖; the others are taken of est⁻¹ · ref, rigid inverse, raw matrices.
///
/// @param reference, estimate   World frames; pose i belongs to pose i (see associate()).
/// @return                      One error per pose.
/// @throws InvalidArgument  if the counts differ or are 0, a pose is not finite, the positions do not fix the
/// alignment, or
///                          the relation is kPointDistanceErrorRatio, which absolute errors do not have.
///
/// Properties (ape_test.cpp), up to rounding:
///   (1) kSe3: invariant when the estimate is moved rigidly    (2) kSim3: also when it is scaled
///
/// Accuracy: evo 1.36 to 1e-9 relative, 1e-12 absolute (tests/oracle/trajectory_oracle_test.cpp).
/// Source:   Sturm et al., A Benchmark for the Evaluation of RGB-D SLAM Systems, 2012; evo.
/// Cost:     O(N).
TrajectoryErrors ape(const Trajectory& reference, const Trajectory& estimate, const ApeSettings& settings = {});

}  // namespace trysquare
