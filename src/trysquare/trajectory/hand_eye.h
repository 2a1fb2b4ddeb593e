// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/pose.h"
#include "trysquare/core/trajectory.h"

#include <cstddef>

namespace trysquare {

/// The pose of a sensor on a body whose trajectories are both known, and how well it explains them.
struct HandEye {
  Pose body_from_sensor{};
  double translation_rms_m =
      0;  ///< Of body_from_sensor · (sensor's motion) against (body's motion) · body_from_sensor.
  double rotation_rms_rad = 0;
  std::size_t num_motions = 0;
};

/// Where the sensor sits, from the motions of both: A_k · X = X · B_k for many pairs of poses (hand-eye calibration).
/// The worlds may differ; the scale must not.
///
/// @param world_from_body, world_from_sensor  Pose i belongs to pose i.
/// @throws InvalidArgument  if the counts differ or are 0, a pose is not finite, or the motions do not fix X: they must
///                          turn about two different axes by several degrees. A car on a plane does not.
///
/// Source: Horaud & Dornaika, Hand-eye calibration, 1995 (rotation by unit quaternions, then translation).
/// Cost:   O(N log N)
HandEye hand_eye(const Trajectory& world_from_body, const Trajectory& world_from_sensor);

}  // namespace trysquare
