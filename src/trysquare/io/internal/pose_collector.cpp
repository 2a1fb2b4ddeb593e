// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/pose_collector.h"

#include "trysquare/core/error.h"
#include "trysquare/io/internal/text.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trysquare::internal {
namespace {

constexpr double kNormWarning = 1e-3;
constexpr double kSmallestNorm = 0.98;
constexpr double kLargestNorm = 1.02;
constexpr int kFewDecimals = 4;

void require_finite(std::span<const double> values, const LineOf& where) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      fail_at(where, fmt::format("number {} of the pose is {}, expected finite numbers", i + 1, values[i]));
    }
  }
}

}  // namespace

Eigen::Matrix3d rotation_of_quaternion(Eigen::Vector4d q_wxyz) {
  q_wxyz *= std::sqrt(2.0 / q_wxyz.squaredNorm());
  const Eigen::Matrix4d q = q_wxyz * q_wxyz.transpose();
  Eigen::Matrix3d rotation;
  rotation << 1 - q(2, 2) - q(3, 3), q(1, 2) - q(3, 0), q(1, 3) + q(2, 0),  //
      q(1, 2) + q(3, 0), 1 - q(1, 1) - q(3, 3), q(2, 3) - q(1, 0),          //
      q(1, 3) - q(2, 0), q(2, 3) + q(1, 0), 1 - q(1, 1) - q(2, 2);
  return rotation;
}

Pose pose_of_matrix(std::span<const double> rows, const LineOf& where) {
  constexpr double kLastRowTolerance = 1e-6;
  constexpr std::array<double, 4> kLastRow = {0, 0, 0, 1};
  require_finite(rows, where);
  for (std::size_t i = 12; i < rows.size(); ++i) {
    if (std::abs(rows[i] - kLastRow[i - 12]) > kLastRowTolerance) {
      fail_at(where,
              fmt::format("the last row of the matrix is {}, expected 0 0 0 1", fmt::join(rows.subspan(12), " ")));
    }
  }
  Pose pose;
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column) {
      pose.rotation(row, column) = rows[static_cast<std::size_t>(4 * row + column)];
    }
    pose.translation[row] = rows[static_cast<std::size_t>(4 * row + 3)];
  }
  const double error = rotation_error(pose.rotation);
  if (error >= kRotationErrorLimit) {
    fail_at(where, std::isinf(error)
                       ? fmt::format("the 3×3 part is no rotation: its determinant is {:.6g}, expected 1",
                                     pose.rotation.determinant())
                       : fmt::format("the 3×3 part is no rotation: RᵀR differs from I by {:.3g}, expected less than {}",
                                     error, kRotationErrorLimit));
  }
  return pose;
}

void fail_at(const LineOf& where, std::string_view message) {
  throw IoError(fmt::format("{}: {} {}: {}", where.file, where.unit, where.line, message));
}

void PoseCollector::Oddity::note(double value, const LineOf& where) {
  if (count++ == 0) first = fmt::format("{}: {} {}", where.file, where.unit, where.line);
  worst = std::max(worst, value);
}

void PoseCollector::add_stamp(std::int64_t stamp_ns, const LineOf& where) {
  std::vector<std::int64_t>& stamps_ns = file_.trajectory.stamps_ns;
  if (!stamps_ns.empty() && stamp_ns <= stamps_ns.back()) not_increasing_.note(0, where);
  stamps_ns.push_back(stamp_ns);
}

void PoseCollector::add_frame(std::int64_t frame, const LineOf& where) {
  if (frame < 0) fail_at(where, fmt::format("found frame {}, expected 0 or more", frame));
  if (!frames_seen_.insert(frame).second) fail_at(where, fmt::format("frame {} has a pose already", frame));
  file_.frames.push_back(frame);
}

void PoseCollector::add_quaternion_pose(const Eigen::Vector3d& translation, const Eigen::Vector4d& q_wxyz,
                                        const LineOf& where) {
  require_finite({translation.data(), 3}, where);
  const double norm = q_wxyz.norm();
  if (!(norm >= kSmallestNorm && norm <= kLargestNorm)) {
    fail_at(where, fmt::format("the quaternion has the norm {:.6g}, expected 1", norm));
  }
  if (std::abs(norm - 1) > kNormWarning) non_unit_.note(std::abs(norm - 1), where);
  file_.trajectory.world_from_scan.push_back({rotation_of_quaternion(q_wxyz), translation});
}

void PoseCollector::add_matrix_pose(std::span<const double> rows, const LineOf& where) {
  const Pose pose = pose_of_matrix(rows, where);
  const double error = rotation_error(pose.rotation);
  if (error > kRotationErrorWarning) not_orthonormal_.note(error, where);
  file_.trajectory.world_from_scan.push_back(pose);
}

void PoseCollector::note_printed(std::string_view token) {
  most_decimals_ = std::max(most_decimals_, printed_decimals(token));
  const double value = parse_double(token).value_or(0);
  any_fraction_ = any_fraction_ || value != std::trunc(value);
}

void PoseCollector::warn(const Oddity& oddity, std::string_view code, std::string_view message) {
  if (oddity.count == 0) return;
  const std::string others = oddity.count > 1 ? fmt::format(" and {} more", oddity.count - 1) : "";
  file_.warnings.push_back({std::string(code), fmt::format("{}{}: {}", oddity.first, others, message)});
}

TrajectoryFile PoseCollector::finish(std::string_view name) {
  const std::size_t num_poses = file_.trajectory.size();
  if (num_poses == 0) throw IoError(fmt::format("{}: line 1: found no poses, expected one or more", name));
  if (const std::size_t num_stamps = file_.trajectory.stamps_ns.size(); num_stamps > 0 && num_stamps != num_poses) {
    throw IoError(fmt::format("{}: line 1: found {} time stamps for {} poses, expected all or none", name, num_stamps,
                              num_poses));
  }
  warn(non_unit_, "non_unit_quaternion",
       fmt::format("the norm of the quaternion differs from 1 by up to {:.3g}; it was normalised", non_unit_.worst));
  warn(not_orthonormal_, "rotation_not_orthonormal",
       fmt::format("rotations are off: RᵀR differs from I by up to {:.3g}; the numbers are used as they are",
                   not_orthonormal_.worst));
  warn(not_increasing_, "time_stamps_not_increasing", "the time stamp is not later than the one before it");
  if (num_poses >= 2 && any_fraction_ && most_decimals_ <= kFewDecimals) {
    file_.warnings.push_back(
        {"rounded_poses", fmt::format("{}: the positions were printed with {} decimals, which moves the metrics "
                                      "of the map; write them with more",
                                      name, most_decimals_)});
  }
  return std::move(file_);
}

}  // namespace trysquare::internal
