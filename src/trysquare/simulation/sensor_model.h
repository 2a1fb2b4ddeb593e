// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <numbers>
#include <string_view>
#include <vector>

namespace trysquare {

/// How the rays of a sensor are spread. Sensor frame: x ahead, y left, z up.
enum class RayPattern {
  kSpinning,  ///< Beams at equal elevations, fired at equal azimuths about z.
  kPinhole,   ///< A camera that looks along x: rows and columns at equal distances on the image plane.
};

/// A range sensor. Rows ("beams") differ in elevation, columns ("azimuths") are fired one after the other.
struct SensorModel {
  RayPattern pattern = RayPattern::kSpinning;
  int num_beams = 32;                                  ///< >= 1
  int num_azimuths = 720;                              ///< >= 1
  double lowest_elevation_rad = -0.5235987755982988;   ///< -30 degrees.
  double highest_elevation_rad = 0.17453292519943295;  ///< +10 degrees.
  double horizontal_fov_rad = 2 * std::numbers::pi;    ///< About x; a full turn has no column twice. Pinhole: < pi.
  double min_range_m = 0.5;                            ///< Nearer and farther returns are lost.
  double max_range_m = 80;
  double range_sigma_m = 0.02;   ///< Standard deviation of the noise along the ray, >= 0.
  double dropout = 0;            ///< Share of returns that are lost at random, in [0, 1].
  bool rolling_shutter = false;  ///< Every column from where the sensor is by then; false: all at one instant.
  double period_s = 0.1;         ///< From the first column to where the next scan's would be, > 0.

  /// @throws InvalidArgument  if a member is out of range.
  void validate() const;

  std::size_t num_rays() const;
};

/// Unit directions of all rays in the frame of the sensor, beam by beam from the lowest, each along the azimuths: from
/// ahead to the left for a full turn, else from right to left.
std::vector<Eigen::Vector3d> ray_directions_in_scan(const SensorModel& sensor);

/// The names that sensor_preset() knows.
std::vector<std::string_view> sensor_preset_names();

/// carla32 (CARLA's default), hdl64 (Velodyne HDL-64E), os1-128 (Ouster OS1), depth-camera.
/// @throws InvalidArgument  if there is no such sensor; the message lists those that there are.
SensorModel sensor_preset(std::string_view name);

}  // namespace trysquare
