// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/parse_trajectory.h"
#include "trysquare/io/write_trajectory.h"

#include <optional>
#include <string_view>

namespace trysquare {

/// Reads poses from a file, or from one matrix file per pose.
///
/// The format of a file is told by its first line of values: 12 are KITTI, 4 or 16 matrices, 8 or more EuRoC when the
/// first is a whole number of 16 to 19 digits [ns], 8 others TUM; 13 beginning with such a number MulRan, 7 beginning
/// with 15 or 16 digits [µs] NCLT, 9 with whole seconds and nanoseconds first and a unit quaternion last Newer College;
/// lines of VERTEX_ and EDGE_ g2o; 4 in a file alidarPose.csv, or whose fourth row is 0 0 0 t, BALM. JSON, and a header
/// with a column `frame`, are CARLA. A directory (its .txt files), and a pattern or comma list that stands for several
/// files, hold one matrix each, in natural order (pose2 before pose10).
///
/// @param spec      a file, a directory, a pattern (* ? [..]) or a comma list.
/// @param format    overrules the detection.
/// @throws IoError  if nothing is found, the format cannot be told, or a file is malformed; the message names the file
///                  and the line.
TrajectoryFile read_trajectory(std::string_view spec, std::optional<TrajectoryFormat> format = {});

}  // namespace trysquare
