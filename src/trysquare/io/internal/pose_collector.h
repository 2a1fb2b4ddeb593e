// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/parse_trajectory.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>

namespace trysquare::internal {

/// A line of a file, for messages; or, with another unit, the n-th of something else.
struct LineOf {
  std::string_view file;
  std::size_t line = 0;
  std::string_view unit = "line";
};

/// @throws IoError  "<file>: <unit> <number>: <message>".
[[noreturn]] void fail_at(const LineOf& where, std::string_view message);

/// Rotation of a quaternion that is a unit one only nearly: q·√(2/|q|²), then outer products, as evo does it.
/// @param q_wxyz  REQUIRES a norm > 0.
Eigen::Matrix3d rotation_of_quaternion(Eigen::Vector4d q_wxyz);

/// The 3×4 or 4×4 numbers of a matrix, row by row, as a pose. Nothing is rounded or re-projected.
/// @throws IoError  if a number is not finite, the rotation is off by kRotationErrorLimit, or the last row is not 0 0
/// 0 1.
Pose pose_of_matrix(std::span<const double> rows, const LineOf& where);

/// Gathers poses, refuses those that are none, and remembers what to warn of.
class PoseCollector {
 public:
  explicit PoseCollector(TrajectoryFormat format) { file_.format = format; }

  void add_stamp(std::int64_t stamp_ns, const LineOf& where);

  /// Number of the next pose. @throws IoError  if another pose has it.
  void add_frame(std::int64_t frame, const LineOf& where);
  void add_quaternion_pose(const Eigen::Vector3d& translation, const Eigen::Vector4d& q_wxyz, const LineOf& where);
  void add_matrix_pose(std::span<const double> rows, const LineOf& where);

  /// How a coordinate of a position was printed.
  void note_printed(std::string_view token);

  /// @throws IoError  if there is no pose.
  TrajectoryFile finish(std::string_view name);

 private:
  /// Something seen in several places.
  struct Oddity {
    std::size_t count = 0;
    double worst = 0;
    std::string first;  ///< "poses.txt: line 3"

    void note(double value, const LineOf& where);
  };

  void warn(const Oddity& oddity, std::string_view code, std::string_view message);

  TrajectoryFile file_;
  std::unordered_set<std::int64_t> frames_seen_;
  Oddity non_unit_;
  Oddity not_orthonormal_;
  Oddity not_increasing_;
  int most_decimals_ = 0;
  bool any_fraction_ = false;  ///< Whole numbers need no decimals.
};

}  // namespace trysquare::internal
