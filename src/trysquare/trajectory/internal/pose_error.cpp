// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/internal/pose_error.h"

#include "trysquare/trajectory/rotation_angle.h"

#include <cmath>
#include <numbers>

namespace trysquare::internal {

Pose relative_pose(const Pose& a, const Pose& b) {
  return {a.rotation.transpose() * b.rotation, a.rotation.transpose() * (b.translation - a.translation)};
}

double magnitude(const Pose& error, PoseRelation relation) {
  switch (relation) {
    case PoseRelation::kFull:
      return std::hypot((error.rotation - Eigen::Matrix3d::Identity()).norm(), error.translation.norm());
    case PoseRelation::kRotationPart:
      return (error.rotation - Eigen::Matrix3d::Identity()).norm();
    case PoseRelation::kRotationAngleDeg:
      return rotation_angle(error.rotation) * (180 / std::numbers::pi);
    case PoseRelation::kRotationAngleRad:
      return rotation_angle(error.rotation);
    case PoseRelation::kTranslationPart:
    case PoseRelation::kPointDistance:
    case PoseRelation::kPointDistanceErrorRatio:
      break;
  }
  return error.translation.norm();
}

}  // namespace trysquare::internal
