// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace trysquare {

/// Transform between two frames, `point_in_b = b_from_a * point_in_a`; the name of a variable says which: `b_from_a`.
///
/// The twelve numbers are kept as they were read: files are orthonormal only to about 1e-7, and re-projecting the
/// rotation moves MME by 1e-6 relative. Whoever needs an inverse chooses one of the two below and says why.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [m]
};

/// point_in_b = b_from_a * point_in_a.
inline Eigen::Vector3d operator*(const Pose& b_from_a, const Eigen::Vector3d& point_in_a) {
  return b_from_a.rotation * point_in_a + b_from_a.translation;
}

/// c_from_a = c_from_b * b_from_a.
inline Pose operator*(const Pose& c_from_b, const Pose& b_from_a) {
  return {c_from_b.rotation * b_from_a.rotation, c_from_b * b_from_a.translation};
}

/// a_from_b as the inverse of the 4×4 matrix, whatever its rotation part is. Map assembly uses this one, as numpy's
/// `inv` does. REQUIRES a regular rotation part.
Pose general_inverse(const Pose& b_from_a);

/// a_from_b = (Rᵀ, −Rᵀt), exact only for an orthonormal rotation. Trajectory errors use this one, as evo does.
Pose rigid_inverse(const Pose& b_from_a);

/// How far a 3×3 matrix is from a rotation: max |RᵀR − I|, or infinity for a reflection or a number that is not finite.
double rotation_error(const Eigen::Matrix3d& rotation);

/// Up to here a rotation is accepted in silence, above with a warning ...
inline constexpr double kRotationErrorWarning = 1e-5;
/// ... and from here on refused (docs/definitions.md#poses).
inline constexpr double kRotationErrorLimit = 1e-3;

}  // namespace trysquare
