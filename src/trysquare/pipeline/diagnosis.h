// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/adjustment_settings.h"
#include "trysquare/adjustment/rpe_estimate.h"
#include "trysquare/core/execution.h"
#include "trysquare/core/pose.h"
#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/pipeline/finding.h"
#include "trysquare/pipeline/ghost_walls.h"
#include "trysquare/pipeline/pose_blame.h"
#include "trysquare/pipeline/time_offset.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// How a diagnosis is made.
struct DiagnosisSettings {
  double radius_m = 0.5;           ///< Of the neighborhoods by which frames are compared; > 0.
  double max_time_offset_s = 0.2;  ///< Offsets between the clocks of scans and poses are sought up to this; > 0.
  AdjustmentSettings adjustment;

  void validate() const;  ///< @throws InvalidArgument
};

/// What may be known besides scans and poses.
struct DiagnosisContext {
  std::optional<Pose> body_from_sensor;  ///< The extrinsic that is part of the trajectory; empty: none was used.
  std::optional<Trajectory> all_poses;   ///< Of the sensor, with stamps, in the same world, also between the scans.
};

/// What is wrong with scans and poses, from the coarse to the fine.
struct Diagnosis {
  std::size_t num_scans = 0;
  Pose world_from_map;            ///< The pose of the first scan.
  std::string reason;             ///< Why nothing could be judged; empty otherwise.
  std::vector<Finding> findings;  ///< Everything of the lists below in a sentence; the worst first.
  std::string blame_reason;       ///< Why poses and walls were not judged (a frame or a clock is wrong); or empty.
  std::optional<RpeEstimate> estimate;  ///< How far off the poses are in all; empty: not judged.
  TimeOffset time_offset;
  std::string suspects_reason;  ///< Why single poses cannot be judged; empty: they were.
  SuspectPoses suspects;
  std::vector<PoseJump> jumps;         ///< In the order of the scans.
  std::vector<PoseOffPath> off_path;   ///< Only where the estimate is refused.
  std::vector<GhostWall> ghost_walls;  ///< At the given poses; most patches first.
};

/// Looks for everything that is commonly wrong with scans and poses: frames (find_frame_mistake), the sequence
/// (check_duplicates, check_gaps), overlap and geometry (estimate_rpe), handedness, time (find_time_offset), single
/// poses and jumps (find_suspects, find_jumps), surfaces that are there twice (find_ghost_walls). While a frame or a
/// clock is wrong the finer ones would only echo it, and are left out.
///
/// @param trajectory  N poses of the N scans as they are used: with the extrinsic, if there is one.
/// @return            Findings are results, not errors. Fewer than three scans, or none with a flat surface: a reason.
/// @throws InvalidArgument  if a setting is out of range, the counts differ, or a pose is not finite or no rotation.
/// @throws IoError          from ScanSequence::load().
///
/// Properties (diagnosis_test.cpp): the same for every number of threads, to the bit.
/// Source: docs/definitions.md#diagnosis.
Diagnosis diagnose(const ScanSequence& scans, const Trajectory& trajectory, const DiagnosisSettings& settings = {},
                   const DiagnosisContext& context = {}, const Execution& execution = {});

}  // namespace trysquare
