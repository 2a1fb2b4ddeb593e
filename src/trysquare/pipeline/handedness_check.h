// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/pipeline/finding.h"

#include <optional>

namespace trysquare {

/// Poses of the other handedness than the points, where the scans overlap all the same: "left_handed". Named where the
/// poses with y negated come at least twice as near to those in which the scans agree, and by 1 cm or more. Errors are
/// the RPE of all pairs, a rotation as what it does at 10 m. A drive straight ahead on a plane is its own mirror image:
/// nothing shows, and nothing is wrong with its metrics.
///
/// @param given     N poses, world_from_scan, N >= 2.
/// @param adjusted  What they should be, as estimate_rpe() finds it; any world frame.
/// @throws InvalidArgument  if the counts differ.
std::optional<Finding> check_handedness(const Trajectory& given, const Trajectory& adjusted);

}  // namespace trysquare
