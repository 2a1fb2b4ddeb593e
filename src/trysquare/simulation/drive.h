// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/simulation/simulated_world.h"

#include <cstddef>
#include <cstdint>

namespace trysquare {

/// How a sensor is carried along a route.
struct DriveSettings {
  std::size_t num_scans = 30;     ///< >= 1
  double step_m = 1;              ///< Way between two scans, > 0; a tenth more or less at random.
  double period_s = 0.1;          ///< Time between two scans, > 0.
  double sway_m = 0.3;            ///< How far to the side of the route, about, >= 0. Slow.
  double heave_sigma_m = 0.02;    ///< Height above the route, scan by scan, >= 0.
  double tilt_sigma_rad = 0.005;  ///< Roll and pitch, scan by scan, >= 0.
  double look_left_rad = 0;       ///< The sensor is turned away from the way ahead by this ...
  double look_down_rad = 0;       ///< ... and then tilted forward, in (-pi/2, pi/2).
  std::uint64_t seed = 0;

  /// @throws InvalidArgument  if a member is out of range.
  void validate() const;
};

/// True poses world_from_scan with time stamps: along the route of the world, looking ahead (or where
/// the settings say). Loops are driven on and
/// on. Pose i draws the same numbers whatever the number of scans.
///
/// @throws InvalidArgument  if a setting is out of range, the world has no route, or its route ends before num_scans
///                          do.
Trajectory drive(const SimulatedWorld& world, const DriveSettings& settings);

/// Length of the way that a drive can take [m]; infinite on a loop.
double length_of_route_m(const SimulatedWorld& world);

}  // namespace trysquare
