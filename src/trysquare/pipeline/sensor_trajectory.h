// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/pose.h"
#include "trysquare/core/trajectory.h"

namespace trysquare {

/// Poses of the sensor from poses of the body that carries it: world_from_sensor = world_from_body · body_from_sensor.
Trajectory sensor_trajectory(const Trajectory& world_from_body, const Pose& body_from_sensor);

/// The same where the world is the first frame of the body, as in KITTI: the world is moved along, so that it is the
/// first frame of the sensor. KITTI: world_from_scan = Tr⁻¹ · T · Tr with the camera as the body.
Trajectory sensor_trajectory_in_sensor_world(const Trajectory& world_from_body, const Pose& body_from_sensor);

}  // namespace trysquare
