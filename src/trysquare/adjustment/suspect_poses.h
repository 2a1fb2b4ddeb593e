// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/pose_errors.h"
#include "trysquare/core/pose.h"

#include <span>
#include <vector>

namespace trysquare {

/// A pose with a higher score is a suspect. By chance: one good pose of 200 among ten with an outlier, fewer among
/// more.
inline constexpr double kSuspectScore = 4;

/// One pose against those around it.
struct PoseDeviation {
  PoseError error;   ///< Beyond what the poses around it share; map frame.
  double score = 0;  ///< Length of the error in robust standard deviations of one axis; the larger of the two parts.
  bool suspect = false;  ///< Stands out from the others.
};

/// Which poses are wrong, rather than all of them a bit: the errors of each pose beyond the median motion of the 21
/// poses around it and their steady drift (of all poses and without drift, in a shorter sequence), in units of
/// what is usual in the sequence.
///
/// @param given      N poses, map_from_scan.
/// @param corrected  What they should be.
/// @return           N deviations. Fewer than four poses have no usual: no suspects.
/// Source: docs/definitions.md#rpe-estimate (suspects).
std::vector<PoseDeviation> deviations_of_poses(std::span<const Pose> given, std::span<const Pose> corrected);

}  // namespace trysquare
