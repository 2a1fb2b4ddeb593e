// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/internal/validate.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

namespace trysquare::internal {
namespace {

void require_finite(const Trajectory& trajectory, const char* name) {
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const Pose& pose = trajectory.world_from_scan[i];
    if (pose.rotation.allFinite() && pose.translation.allFinite()) continue;
    throw InvalidArgument(fmt::format("pose {} of the {} has a number that is not finite", i, name));
  }
}

}  // namespace

void validate_poses(const Trajectory& reference, const Trajectory& estimate) {
  if (reference.size() != estimate.size()) {
    throw InvalidArgument(fmt::format("the reference has {} poses and the estimate {}: associate them first",
                                      reference.size(), estimate.size()));
  }
  if (reference.size() == 0) throw InvalidArgument("reference and estimate have no poses");
  require_finite(reference, "reference");
  require_finite(estimate, "estimate");
}

}  // namespace trysquare::internal
