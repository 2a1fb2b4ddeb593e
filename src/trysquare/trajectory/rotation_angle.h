// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace trysquare {

/// Direction of the unit quaternion (x, y, z, w) of a rotation matrix; neither its length nor its sign is fixed.
///
/// All four components are read off the column of 4qqᵀ whose diagonal entry is the largest, so nothing cancels at any
/// angle.
/// Source:  Shepperd, Quaternion from rotation matrix, 1978.
Eigen::Vector4d quaternion_direction(const Eigen::Matrix3d& rotation);

/// Angle of a rotation [rad], in [0, π], to full precision at both ends (an arc cosine loses everything below 1e-8).
///
/// Taken as 2·atan2(‖(x, y, z)‖, |w|) of quaternion_direction(): on matrices that are orthonormal to 1e-7 only, as
/// those of KITTI, this is what evo's numbers are; ½‖R − Rᵀ‖ and the trace in one atan2 is 3e-8 off
/// (docs/definitions.md).
double rotation_angle(const Eigen::Matrix3d& rotation);

/// The same of a quaternion direction (x, y, z, w).
double rotation_angle(const Eigen::Vector4d& quaternion);

}  // namespace trysquare
