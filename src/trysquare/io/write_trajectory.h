// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/io/parse_trajectory.h"

#include <filesystem>
#include <string>

namespace trysquare {

/// TUM, KITTI, EuRoC and matrices.
bool can_be_written(TrajectoryFormat format);

/// Poses as text, with 17 significant digits, which give every double back; time stamps are exact to the nanosecond.
/// TUM and EuRoC need time stamps: without them, pose i gets i seconds. They also need quaternions, which hold
/// rotations only: a matrix that is off by 1e-7 comes back without that. KITTI and matrices keep the numbers. kMatrices
/// are 4×4 blocks below each other.
/// @throws InvalidArgument  if the format cannot be written, there is no pose, or neither none nor one time stamp for
/// each.
std::string format_trajectory(const Trajectory& trajectory, TrajectoryFormat format);

/// format_trajectory into a file, whole or not at all.
/// @throws IoError  if the file cannot be written.
void write_trajectory(const std::filesystem::path& path, const Trajectory& trajectory, TrajectoryFormat format);

}  // namespace trysquare
