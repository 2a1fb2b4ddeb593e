// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/spinning_sensor.h"

#include "trysquare/core/error.h"

#include <cmath>
#include <numbers>
#include <string>

namespace trysquare {
namespace {

void require(bool in_range, const char* name, double value, const char* range) {
  if (in_range) return;
  throw InvalidArgument(std::string(name) + " = " + std::to_string(value) + " is out of range: it must be " + range);
}

Eigen::Vector3d ray_direction(const SpinningSensor& sensor, int beam, int step) {
  const double share = sensor.num_beams == 1 ? 0.5 : static_cast<double>(beam) / (sensor.num_beams - 1);
  const double elevation = std::lerp(sensor.lowest_elevation_rad, sensor.highest_elevation_rad, share);
  const double azimuth = 2 * std::numbers::pi * step / sensor.num_azimuths;
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

}  // namespace

void SpinningSensor::validate() const {
  constexpr double kStraightUp = std::numbers::pi / 2;
  require(num_beams >= 1, "num_beams", num_beams, ">= 1");
  require(num_azimuths >= 1, "num_azimuths", num_azimuths, ">= 1");
  require(std::abs(lowest_elevation_rad) <= kStraightUp, "lowest_elevation_rad", lowest_elevation_rad,
          "in [-pi/2, pi/2]");
  require(std::abs(highest_elevation_rad) <= kStraightUp, "highest_elevation_rad", highest_elevation_rad,
          "in [-pi/2, pi/2]");
  require(min_range_m >= 0, "min_range_m", min_range_m, ">= 0");
  require(max_range_m > min_range_m, "max_range_m", max_range_m, "> min_range_m");
  require(range_sigma_m >= 0 && std::isfinite(range_sigma_m), "range_sigma_m", range_sigma_m, ">= 0");
}

Scan cast_scan(std::span<const Rectangle> scene, const Pose& world_from_scan, const SpinningSensor& sensor,
               Random& random) {
  sensor.validate();
  Scan scan;
  for (int beam = 0; beam < sensor.num_beams; ++beam) {
    for (int step = 0; step < sensor.num_azimuths; ++step) {
      const Eigen::Vector3d direction = ray_direction(sensor, beam, step);
      const auto hit = cast_ray(scene, world_from_scan.translation, world_from_scan.rotation * direction);
      if (!hit) continue;
      const double range = hit->distance_m + sensor.range_sigma_m * random.normal();
      if (range > sensor.min_range_m && range < sensor.max_range_m) scan.points_in_scan.emplace_back(range * direction);
    }
  }
  return scan;
}

}  // namespace trysquare
