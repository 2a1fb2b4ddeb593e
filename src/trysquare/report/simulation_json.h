// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace trysquare {

/// A range sensor as it is reported; the words are those of the command line.
struct SimulatedSensorFacts {
  std::string name{};  ///< Of the preset, e.g. "hdl64".
  int num_beams = 0;
  int num_azimuths = 0;
  double lowest_elevation_rad = 0;
  double highest_elevation_rad = 0;
  double horizontal_fov_rad = 0;
  double min_range_m = 0;
  double max_range_m = 0;
  double range_sigma_m = 0;
  double dropout = 0;
  bool rolling_shutter = false;
};

/// A world of discs that every scan sees.
struct SimulatedPlanesFacts {
  std::size_t num_discs = 0;
  std::size_t points_per_disc = 0;
  double disc_radius_m = 0;
  double point_sigma_m = 0;
};

/// What was simulated, and what came of it.
struct SimulationFacts {
  std::string version{};               ///< Of trysquare.
  std::string world{};                 ///< "planes", "street", "town", "room", "office" or "mesh".
  std::optional<std::string> style{};  ///< Of a town: "grid", "suburb" or "oldtown".
  std::optional<std::string> mesh{};   ///< The file as typed.
  std::optional<std::string> poses{};  ///< The file as typed.
  std::optional<double> step_m{};      ///< Between two scans, without a file of poses.
  std::uint64_t seed = 0;
  std::size_t num_moving_cars = 0;
  std::size_t num_triangles = 0;                 ///< Of what stands still.
  std::optional<SimulatedSensorFacts> sensor{};  ///< All worlds but "planes".
  std::optional<SimulatedPlanesFacts> planes{};  ///< "planes".
  std::size_t num_scans = 0;
  std::uint64_t num_points = 0;
  std::size_t num_points_min = 0;  ///< Of a scan.
  std::size_t num_points_max = 0;
  double path_length_m = 0;
};

/// A simulation as JSON text, schema "trysquare.simulation/1" (docs/schema/simulation.schema.json). Angles are degrees.
/// Same input, same bytes.
std::string to_json(const SimulationFacts& facts);

}  // namespace trysquare
