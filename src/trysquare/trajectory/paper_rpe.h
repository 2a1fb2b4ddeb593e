// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"

namespace trysquare {

/// The paper's RPE: 1/N · Σ over ordered pairs i ≠ j of the squared translation of E_ij, as in rpe(). [m²], lower is
/// better.
///
/// It grows with the number of poses: about (N − 1) times the mean squared translation error of a pair.
///
/// @param reference, estimate   Pose i belongs to pose i.
/// @throws InvalidArgument  if the counts differ, there are fewer than two poses, or a pose is not finite.
///
/// Properties (paper_rpe_test.cpp), up to rounding:
///   (1) for errors along one axis, their sample variance is paper_rpe / (2 (N − 1)): Lemma 1 of the paper
///   (2) invariant under a rigid motion of either world
///
/// Source:   Kornilova & Ferrer, Be your own Benchmark, 2021.
/// Differs:  ordered pairs and 1/N are the reading that makes Lemma 1 hold; T_i⁻¹ T_j instead of T_i T_j⁻¹
///           (docs/definitions.md#rpe).
/// Cost:     O(N²) time, O(N) memory.
double paper_rpe(const Trajectory& reference, const Trajectory& estimate);

}  // namespace trysquare
