// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/rpe_estimate.h"
#include "trysquare/core/trajectory.h"

#include <array>
#include <cstddef>
#include <vector>

namespace trysquare {

/// A pose that stands out from those around it, and by how much.
struct SuspectPose {
  std::size_t scan = 0;
  double translation_m = 0;  ///< Length of its error beyond what the poses around it share.
  double rotation_rad = 0;
  std::array<double, 2> translation_interval_m{};  ///< Two standard deviations to either side, cut at 0.
  std::array<double, 2> rotation_interval_rad{};
  double score = 0;  ///< Error in robust standard deviations of the sequence; see suspect_poses.h.
};

/// Consecutive poses that stand out from the others together.
struct PoseGroup {
  std::size_t first = 0;
  std::size_t last = 0;      ///< Inclusive.
  bool is_drift = false;     ///< No step to them or from them jumps: the error grows and shrinks bit by bit.
  double translation_m = 0;  ///< Largest error of these poses beyond what the poses around them share.
  double rotation_rad = 0;
};

/// Whom the scans blame.
struct SuspectPoses {
  std::vector<SuspectPose> poses;  ///< The largest error first, a rotation as what it does at 10 m.
  std::vector<PoseGroup> groups;   ///< In the order of the scans.
};

/// The suspects of an estimate whose error is also larger than what the estimate knows: than 1 cm, two of its own
/// standard deviations and twice the difference between the estimate's two halves; or the same of the rotation, with
/// 0.1 degrees. Runs of them end where a step is off by 60 % of the error there, a jump. Three or more are a group; a
/// group without a jump to it or from it is a drift, and one or two poses without a jump are nothing.
///
/// @param given     N poses, world_from_scan.
/// @param estimate  Of them. Refused: no suspects.
SuspectPoses find_suspects(const Trajectory& given, const RpeEstimate& estimate);

/// A step from one pose to the next that the scans contradict: as where poses after it belong to other scans, or a
/// registration slipped.
struct PoseJump {
  std::size_t from = 0;  ///< Between the scans from and from + 1.
  double translation_m = 0;
  double rotation_rad = 0;
  double limit_m = 0;  ///< One of the two parts is above its limit.
  double limit_rad = 0;
};

/// Steps whose error stands out: above 3.5 times the median of all steps, 3 cm or 0.2 degrees, and twice the
/// difference between the estimate's two halves. The two steps beside a single suspect are its own and no jumps.
///
/// @param given     N poses, world_from_scan.
/// @param estimate  Of them; without adjusted poses there are no jumps, nor with fewer than five steps.
/// @param suspects  Of find_suspects().
std::vector<PoseJump> find_jumps(const Trajectory& given, const RpeEstimate& estimate,
                                 const std::vector<SuspectPose>& suspects);

/// A pose beside the path of its neighbors.
struct PoseOffPath {
  std::size_t scan = 0;
  double distance_m = 0;  ///< From the middle of its two neighbors.
  double limit_m = 0;
};

/// Poses that leave the path without a look at the scans, for when these do not say where they stood: farther from the
/// middle of their two neighbors than 10 times the median of all poses and 0.3 m, and farther than those neighbors from
/// the middle of theirs. Fewer than six poses have no usual path.
std::vector<PoseOffPath> find_poses_off_path(const Trajectory& given);

}  // namespace trysquare
