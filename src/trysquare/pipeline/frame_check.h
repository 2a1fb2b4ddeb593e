// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/diagnostic.h"
#include "trysquare/core/execution.h"
#include "trysquare/core/pose.h"
#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"

#include <cstddef>
#include <optional>
#include <string>

namespace trysquare {

/// Poses in a wrong frame, and by what it shows.
struct FrameMistake {
  std::string code;            ///< "camera_frame", "extrinsic_not_needed", "extrinsic_inverted", "poses_inverted" or
                               ///< "left_handed".
  std::string mistake;         ///< What it looks like.
  std::string remedy;          ///< What to do.
  double scans_given = 0;      ///< Scans per neighborhood with the poses as given, on average ...
  double scans_corrected = 0;  ///< ... and with the mistake corrected ...
  std::size_t num_scans = 0;   ///< ... of so many that were looked at.
};

/// Tests whether the poses are in the wrong frame: of a camera instead of the scanner, with the calibration forgotten
/// or inverted, maps from the world instead of to it, or of the other handedness than the points. Such mistakes can
/// make every metric look better.
///
/// Maps of some scans are assembled with the poses as given and with each likely correction. A correction that lets the
/// scans overlap clearly better (twice as many scans per neighborhood, or more at a smaller plane variance) is named.
///
/// @param trajectory        Poses of the scans as they are used: with the extrinsic, if there is one.
/// @param body_from_sensor  The extrinsic that is part of `trajectory`; empty: none was used.
/// @param radius_m          Of the neighborhoods [m].
/// @return                  The correction that fits best, or nothing. Fewer than three scans or scans without overlap
///                          are too little to tell: nothing.
/// Source: docs/definitions.md#overlap.
std::optional<FrameMistake> find_frame_mistake(const ScanSequence& scans, const Trajectory& trajectory,
                                               const std::optional<Pose>& body_from_sensor, double radius_m,
                                               const Execution& execution = {});

/// What find_frame_mistake() finds, as a warning.
std::optional<Diagnostic> check_frames(const ScanSequence& scans, const Trajectory& trajectory,
                                       const std::optional<Pose>& body_from_sensor, double radius_m,
                                       const Execution& execution = {});

}  // namespace trysquare
