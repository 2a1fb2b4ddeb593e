// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/simulation_json.h"

#include "trysquare/report/internal/json.h"
#include "trysquare/report/internal/statistics_json.h"

namespace trysquare {
namespace {

using internal::Json;
using internal::kDegreesPerRadian;

Json sensor_json(const SimulatedSensorFacts& sensor) {
  return {{"name", sensor.name},
          {"num_beams", sensor.num_beams},
          {"num_azimuths", sensor.num_azimuths},
          {"lowest_elevation_deg", sensor.lowest_elevation_rad * kDegreesPerRadian},
          {"highest_elevation_deg", sensor.highest_elevation_rad * kDegreesPerRadian},
          {"horizontal_fov_deg", sensor.horizontal_fov_rad * kDegreesPerRadian},
          {"min_range_m", sensor.min_range_m},
          {"max_range_m", sensor.max_range_m},
          {"range_sigma_m", sensor.range_sigma_m},
          {"dropout", sensor.dropout},
          {"rolling_shutter", sensor.rolling_shutter}};
}

Json planes_json(const SimulatedPlanesFacts& planes) {
  return {{"num_discs", planes.num_discs},
          {"points_per_disc", planes.points_per_disc},
          {"disc_radius_m", planes.disc_radius_m},
          {"point_sigma_m", planes.point_sigma_m}};
}

Json settings_json(const SimulationFacts& facts) {
  Json settings = {{"world", facts.world}};
  if (facts.style) settings["style"] = *facts.style;
  settings["seed"] = facts.seed;
  if (facts.step_m) settings["step_m"] = *facts.step_m;
  if (facts.sensor) {
    settings["num_moving_cars"] = facts.num_moving_cars;
    settings["sensor"] = sensor_json(*facts.sensor);
  }
  if (facts.planes) settings["planes"] = planes_json(*facts.planes);
  return settings;
}

}  // namespace

std::string to_json(const SimulationFacts& facts) {
  const auto text_or_null = [](const std::optional<std::string>& text) { return text ? Json(*text) : Json(nullptr); };
  Json json = {{"schema", "trysquare.simulation/1"}, {"version", facts.version}};
  json["inputs"] = {{"mesh", text_or_null(facts.mesh)}, {"poses", text_or_null(facts.poses)}};
  json["settings"] = settings_json(facts);
  json["num_triangles"] = facts.num_triangles;
  json["num_scans"] = facts.num_scans;
  json["num_points"] = facts.num_points;
  json["num_points_min"] = facts.num_points_min;
  json["num_points_max"] = facts.num_points_max;
  json["path_length_m"] = facts.path_length_m;
  return internal::dump(json);
}

}  // namespace trysquare
