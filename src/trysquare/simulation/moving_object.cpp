// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/moving_object.h"

#include "trysquare/simulation/internal/polyline.h"

#include <cmath>

namespace trysquare {

Pose MovingObject::world_from_object(double time_s) const {
  constexpr double kHalfWheelbase = 1.3;
  const bool is_closed = path_in_world.front() == path_in_world.back();
  const internal::Polyline path(path_in_world, false);
  const double length = path.length_m();
  const double way = start_m + speed_mps * time_s;
  const double s = way - length * std::floor(way / length);
  const internal::Polyline loop =
      is_closed ? internal::Polyline({path_in_world.begin(), path_in_world.end() - 1}, true) : path;
  return {internal::rotation_looking(loop.ahead(s, kHalfWheelbase)), loop.at(s)};
}

}  // namespace trysquare
