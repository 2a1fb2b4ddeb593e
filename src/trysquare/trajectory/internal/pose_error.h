// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/pose.h"
#include "trysquare/trajectory/pose_relation.h"

namespace trysquare::internal {

/// a⁻¹ · b with the rigid inverse of a. The translation is Rᵀ of a difference, so world coordinates of UTM size cost no
/// digits.
Pose relative_pose(const Pose& a, const Pose& b);

/// The number that `relation` takes of a pose error. For kPointDistance the length of the translation.
double magnitude(const Pose& error, PoseRelation relation);

}  // namespace trysquare::internal
