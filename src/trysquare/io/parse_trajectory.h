// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/diagnostic.h"
#include "trysquare/core/trajectory.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace trysquare {

/// The shapes in which poses are stored as text.
enum class TrajectoryFormat {
  kTum,           ///< t x y z qx qy qz qw, t in seconds.
  kKitti,         ///< The upper 3×4 of a matrix, row by row, 12 numbers a line. No time stamps.
  kEuroc,         ///< t,x,y,z,qw,qx,qy,qz and more columns, which are ignored; t in nanoseconds.
  kMatrices,      ///< 4×4 matrices: four lines of 4 numbers or one of 16 each. No time stamps.
  kNclt,          ///< utime x y z roll pitch yaw; [µs], [rad], Rz·Ry·Rx. Rows with NaN are left out.
  kMulran,        ///< global_pose.csv of MulRan: a time [ns] and a 3×4 matrix, 13 numbers a line.
  kNewerCollege,  ///< registered_poses.csv: sec nsec x y z qx qy qz qw.
  kG2o,           ///< The lines VERTEX_SE3:QUAT id x y z qx qy qz qw. No time stamps.
  kBalm,          ///< alidarPose.csv of BALM: as kMatrices, but the last number of each is a time [s].
  kCarla,  ///< Transforms of an actor of CARLA, CSV or JSON, by frame number; see docs/user/carla.md. Left-handed.
};

/// "tum", "kitti", "euroc", "matrix", "carla", "nclt", "mulran", "newer-college", "g2o", "balm", the words of
/// `--poses-format`.
std::string_view name_of(TrajectoryFormat format);
std::optional<TrajectoryFormat> trajectory_format_named(std::string_view name);

/// A trajectory, and what is odd about it. The codes of the warnings:
///   non_unit_quaternion         |q| is off by more than 1e-3; the rotation was normalised
///   rotation_not_orthonormal    max |RᵀR − I| lies between kRotationErrorWarning and kRotationErrorLimit
///   rounded_poses               the positions were printed with four decimals or fewer
///   time_stamps_not_increasing  a time stamp is not later than the one before it
struct TrajectoryFile {
  Trajectory trajectory;
  std::vector<std::int64_t> frames;  ///< Of kCarla: the frame number of each pose, no number twice. Else empty.
  TrajectoryFormat format = TrajectoryFormat::kTum;
  std::vector<Diagnostic> warnings;
};

/// Poses from text. Values are parted by white space, commas or semicolons; comments follow # or //; byte order marks
/// and CRLF are fine. Matrices keep their numbers as read. Quaternions become rotations with q·√(2/|q|²), as in evo.
/// Time stamps are read digit by digit, to the nanosecond.
/// @param name      what messages call the text: the path, usually.
/// @throws IoError  naming the line: another number of values than the format has, text, NaN, |q| off by 0.02,
///                  a rotation that is off by kRotationErrorLimit, a last row that is not 0 0 0 1; or if there is no
///                  pose.
/// Source: TUM https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats, KITTI devkit_odometry's readme.txt,
///         EuRoC (Burri et al. 2016) state_groundtruth_estimate0/data.csv.
TrajectoryFile parse_trajectory(std::string_view text, std::string_view name, TrajectoryFormat format);

/// parse_trajectory without the warnings.
Trajectory parse_tum(std::string_view text, std::string_view name);
Trajectory parse_kitti(std::string_view text, std::string_view name);
Trajectory parse_euroc(std::string_view text, std::string_view name);
Trajectory parse_matrices(std::string_view text, std::string_view name);

}  // namespace trysquare
