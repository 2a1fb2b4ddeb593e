// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/sensor_trajectory.h"

namespace trysquare {

Trajectory sensor_trajectory(const Trajectory& world_from_body, const Pose& body_from_sensor) {
  Trajectory result = world_from_body;
  for (Pose& pose : result.world_from_scan) pose = pose * body_from_sensor;
  return result;
}

Trajectory sensor_trajectory_in_sensor_world(const Trajectory& world_from_body, const Pose& body_from_sensor) {
  const Pose sensor_from_body = general_inverse(body_from_sensor);
  Trajectory result = sensor_trajectory(world_from_body, body_from_sensor);
  for (Pose& pose : result.world_from_scan) pose = sensor_from_body * pose;
  return result;
}

}  // namespace trysquare
