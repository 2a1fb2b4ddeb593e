// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/pose.h"

#include <filesystem>
#include <string_view>

namespace trysquare {

/// The line `Tr:` (odometry), `Tr_velo_to_cam:` (object) or `Tr_velo_cam` (tracking) of a KITTI calib.txt; the numbers
/// are kept as read.
/// @return          camera0_from_velodyne.
/// @throws IoError  if the line is missing, there twice, has not 12 numbers, or its rotation is off by
///                  kRotationErrorLimit.
/// Source: devkit_odometry's readme.txt.
Pose parse_kitti_calibration(std::string_view text, std::string_view name);
Pose read_kitti_calibration(const std::filesystem::path& path);

/// An extrinsic calibration: the 12 numbers of a 3×4 or the 16 of a 4×4 matrix, row by row, in any number of lines,
/// parted by white space, commas or semicolons.
/// @param file_or_numbers  the path of such a text, or the text itself.
/// @return          body_from_sensor.
/// @throws IoError  if there is no such file and the text is no such numbers, or they are no pose.
Pose read_extrinsic(std::string_view file_or_numbers);

}  // namespace trysquare
