// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"

#include <cstdint>

namespace trysquare {

/// White noise on poses, independent from pose to pose and axis to axis.
struct PerturbationSettings {
  double translation_sigma_m = 0;  ///< Standard deviation per axis of the world frame [m], >= 0.
  double rotation_sigma_rad = 0;   ///< Standard deviation per axis of the rotation vector, in the scan frame, >= 0.
  std::uint64_t seed = 0;

  /// @throws InvalidArgument  if a member is not finite or negative.
  void validate() const;
};

/// `trajectory` with random errors: world_from_scan becomes (R · exp(ω), t + e). Pose i draws the same numbers whatever
/// the number of poses; stamps are kept.
Trajectory perturb(const Trajectory& trajectory, const PerturbationSettings& settings);

}  // namespace trysquare
