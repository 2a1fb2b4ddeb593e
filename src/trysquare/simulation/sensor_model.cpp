// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/sensor_model.h"

#include "trysquare/simulation/internal/require.h"

#include <array>
#include <cmath>
#include <utility>

namespace trysquare {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;

/// Position i of n, spread evenly over [low, high].
double spread(double low, double high, int i, int n) {
  return std::lerp(low, high, n == 1 ? 0.5 : static_cast<double>(i) / (n - 1));
}

Eigen::Vector3d spinning_direction(const SensorModel& sensor, int beam, int column) {
  const double elevation = spread(sensor.lowest_elevation_rad, sensor.highest_elevation_rad, beam, sensor.num_beams);
  const bool full_turn = sensor.horizontal_fov_rad >= 2 * std::numbers::pi;
  const double half = sensor.horizontal_fov_rad / 2;
  const double azimuth = full_turn ? 2 * std::numbers::pi * column / sensor.num_azimuths
                                   : spread(-half, half, column, sensor.num_azimuths);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

Eigen::Vector3d pinhole_direction(const SensorModel& sensor, int beam, int column) {
  const double side = std::tan(sensor.horizontal_fov_rad / 2);
  const double y = spread(-side, side, column, sensor.num_azimuths);
  const double z =
      spread(std::tan(sensor.lowest_elevation_rad), std::tan(sensor.highest_elevation_rad), beam, sensor.num_beams);
  return Eigen::Vector3d(1, y, z).normalized();
}

/// Velodyne's data sheet: 64 lasers over 26.8 degrees, 10 Hz, 120 m, less than 2 cm.
SensorModel hdl64() {
  return {.num_beams = 64,
          .num_azimuths = 2048,
          .lowest_elevation_rad = -24.8 * kDegrees,
          .highest_elevation_rad = 2 * kDegrees,
          .min_range_m = 0.9,
          .max_range_m = 120,
          .range_sigma_m = 0.02};
}

/// Ouster's data sheet: 45 degrees, 1024 columns at 10 Hz, 100 m.
SensorModel os1_128() {
  return {.num_beams = 128,
          .num_azimuths = 1024,
          .lowest_elevation_rad = -22.5 * kDegrees,
          .highest_elevation_rad = 22.5 * kDegrees,
          .min_range_m = 0.3,
          .max_range_m = 100,
          .range_sigma_m = 0.015};
}

/// The field of view of a telephone's depth sensor.
SensorModel depth_camera() {
  return {.pattern = RayPattern::kPinhole,
          .num_beams = 120,
          .num_azimuths = 160,
          .lowest_elevation_rad = -24 * kDegrees,
          .highest_elevation_rad = 24 * kDegrees,
          .horizontal_fov_rad = 62 * kDegrees,
          .min_range_m = 0.2,
          .max_range_m = 7,
          .range_sigma_m = 0.01};
}

using Preset = std::pair<std::string_view, SensorModel (*)()>;
constexpr std::array<Preset, 4> kPresets = {{{"carla32", [] { return SensorModel{}; }},
                                             {"hdl64", hdl64},
                                             {"os1-128", os1_128},
                                             {"depth-camera", depth_camera}}};

}  // namespace

void SensorModel::validate() const {
  using internal::require;
  const bool pinhole = pattern == RayPattern::kPinhole;
  const double steepest = std::numbers::pi / 2;
  const auto is_elevation = [&](double angle) {
    return pinhole ? std::abs(angle) < steepest : std::abs(angle) <= steepest;
  };
  require(num_beams >= 1, "num_beams", num_beams, ">= 1");
  require(num_azimuths >= 1, "num_azimuths", num_azimuths, ">= 1");
  require(is_elevation(lowest_elevation_rad), "lowest_elevation_rad", lowest_elevation_rad, "within pi/2 of level");
  require(is_elevation(highest_elevation_rad), "highest_elevation_rad", highest_elevation_rad, "within pi/2 of level");
  require(highest_elevation_rad >= lowest_elevation_rad, "highest_elevation_rad", highest_elevation_rad,
          ">= lowest_elevation_rad");
  const double widest = pinhole ? std::numbers::pi : 2 * std::numbers::pi * (1 + 1e-12);
  require(horizontal_fov_rad > 0 && horizontal_fov_rad < widest, "horizontal_fov_rad", horizontal_fov_rad,
          pinhole ? "> 0 and < pi" : "> 0 and <= 2 pi");
  require(min_range_m >= 0, "min_range_m", min_range_m, ">= 0");
  require(max_range_m > min_range_m && std::isfinite(max_range_m), "max_range_m", max_range_m, "> min_range_m");
  require(range_sigma_m >= 0 && std::isfinite(range_sigma_m), "range_sigma_m", range_sigma_m, ">= 0");
  require(dropout >= 0 && dropout <= 1, "dropout", dropout, "0 to 1");
  require(period_s > 0 && std::isfinite(period_s), "period_s", period_s, "> 0");
}

std::size_t SensorModel::num_rays() const {
  return static_cast<std::size_t>(num_beams) * static_cast<std::size_t>(num_azimuths);
}

std::vector<Eigen::Vector3d> ray_directions_in_scan(const SensorModel& sensor) {
  sensor.validate();
  const auto direction = sensor.pattern == RayPattern::kPinhole ? pinhole_direction : spinning_direction;
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(sensor.num_rays());
  for (int beam = 0; beam < sensor.num_beams; ++beam) {
    for (int column = 0; column < sensor.num_azimuths; ++column) directions.push_back(direction(sensor, beam, column));
  }
  return directions;
}

std::vector<std::string_view> sensor_preset_names() {
  std::vector<std::string_view> names;
  for (const Preset& preset : kPresets) names.push_back(preset.first);
  return names;
}

SensorModel sensor_preset(std::string_view name) {
  std::string known;
  for (const auto& [preset_name, make] : kPresets) {
    if (preset_name == name) return make();
    if (!known.empty()) known += ", ";
    known += preset_name;
  }
  throw InvalidArgument("there is no sensor \"" + std::string(name) + "\"; there are " + known);
}

}  // namespace trysquare
