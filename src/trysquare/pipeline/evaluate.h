// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/pose.h"
#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/metrics/orthogonal_subset.h"
#include "trysquare/pipeline/evaluation.h"
#include "trysquare/pipeline/evaluation_settings.h"

#include <optional>

namespace trysquare {

/// What may be known besides scans and poses.
struct EvaluationContext {
  std::optional<OrthogonalSubset> subset;  ///< Map frame; empty: extracted from the scans.
  std::optional<Trajectory> reference;     ///< True poses of the same scans, for RPE and APE.
  std::optional<Pose> body_from_sensor;    ///< The extrinsic that is part of the trajectory; empty: none.
};

/// Judges a trajectory by the map that it makes of the scans: the straight path from scans and poses to every metric.
///
/// @param scans       N scans; loaded once for the map and once for each window that they are in.
/// @param trajectory  N poses, world_from_scan.
/// @param settings    What is computed and how.
/// @param execution   Threads; its callback hears "scans", "neighborhoods", "windows". Results do not depend on it.
/// @return            Undefined metrics are empty with a reason, and `verdict` says whether the rest means anything.
/// @throws InvalidArgument  if a setting is out of range, the numbers of scans and poses (or of reference poses)
/// differ,
///                          or a pose is not a rotation and a translation.
/// @throws IoError          from ScanSequence::load().
///
/// Source: Kornilova & Ferrer, "Be your own Benchmark", §III and §IV; docs/definitions.md.
Evaluation evaluate(const ScanSequence& scans, const Trajectory& trajectory, const EvaluationSettings& settings,
                    const EvaluationContext& context = {}, const Execution& execution = {});

/// The same for one registered map without poses: no overlap, no windows, no reference.
/// @param map  Its points in the map frame [m]; points at the origin are kept.
Evaluation evaluate_map(const Scan& map, const EvaluationSettings& settings, const EvaluationContext& context = {},
                        const Execution& execution = {});

}  // namespace trysquare
