// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trysquare {

/// The error of the poses at one offset in time.
struct TimeOffsetCost {
  double offset_s = 0;
  double error_m = 0;  ///< RPE of all pairs against the adjusted poses, a rotation as what it does at 10 m.
};

/// Whether the poses belong to another time than the scans.
struct TimeOffset {
  std::optional<double> offset_s;      ///< Each scan belongs to the pose so much later; empty: none is named.
  std::string reason;                  ///< Why it is empty.
  std::optional<double> resolution_s;  ///< So far from the best offset the squared error has doubled; empty: nothing
                                       ///< was tried, or the motion is so steady that no offset makes a difference.
  std::size_t num_scans = 0;           ///< Scans that have poses around them at every offset: what was looked at.
  std::vector<TimeOffsetCost> costs;   ///< What was tried, ascending; empty: nothing.
  std::optional<TimeOffsetCost> best;  ///< Between those; empty: nothing was tried.
};

/// Seeks the offset in time at which the poses come closest to those in which the scans agree: poses are interpolated
/// at the times of the scans plus an offset, for offsets of 25 ms from -max_offset_s to max_offset_s, and a parabola
/// refines the best.
///
/// Motion that is steady in speed and turn hides an offset: a shift then moves the whole map, and no scan against
/// another; `resolution_s` says how much of it shows. The offset is named where at most half of the error is left and
/// the error falls by 1 cm or more, which chance hardly does.
///
/// @param poses           M poses, world_from_scan, with ascending stamps, at any rate.
/// @param scan_stamps_ns  N times of the scans, in the clock of the poses but for the offset.
/// @param adjusted        N poses that the scans should have, as estimate_rpe() finds them; any world frame.
/// @param max_offset_s    > 0 [s]. Scans nearer than this to the first or last pose are left out.
/// @throws InvalidArgument  if there is not one scan stamp per adjusted pose, or `poses` has no stamps.
/// Source: docs/definitions.md#diagnosis.
TimeOffset find_time_offset(const Trajectory& poses, std::span<const std::int64_t> scan_stamps_ns,
                            const Trajectory& adjusted, double max_offset_s = 0.2);

}  // namespace trysquare
