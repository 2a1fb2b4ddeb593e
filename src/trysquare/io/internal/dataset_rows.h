// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/internal/pose_collector.h"

#include <string_view>

namespace trysquare::internal {

/// NCLT: utime [µs], x, y, z, roll, pitch, yaw [rad], the rotation Rz·Ry·Rx. Rows with NaN, which its first ones are,
/// are left out.
void collect_nclt(std::string_view text, std::string_view name, PoseCollector& poses);

/// MulRan, global_pose.csv: a time [ns] and the twelve numbers of a 3×4 matrix.
void collect_mulran(std::string_view text, std::string_view name, PoseCollector& poses);

/// Newer College, registered_poses.csv: sec, nsec, x, y, z, qx, qy, qz, qw.
void collect_newer_college(std::string_view text, std::string_view name, PoseCollector& poses);

/// g2o: the lines VERTEX_SE3:QUAT id x y z qx qy qz qw, in their order; other lines are skipped.
void collect_g2o(std::string_view text, std::string_view name, PoseCollector& poses);

/// BALM, alidarPose.csv: 4×4 matrices below each other whose last number is a time [s].
void collect_balm(std::string_view text, std::string_view name, PoseCollector& poses);

}  // namespace trysquare::internal
