// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/pose.h"
#include "trysquare/core/scan.h"
#include "trysquare/synthetic/random.h"
#include "trysquare/synthetic/rectangle.h"

#include <span>

namespace trysquare {

/// A LiDAR that spins about its z axis: beams at equal elevations, fired at equal azimuths, all at one instant.
struct SpinningSensor {
  int num_beams = 32;                     ///< >= 1
  int num_azimuths = 720;                 ///< >= 1
  double lowest_elevation_rad = -0.5236;  ///< -30 degrees: CARLA's default sensor.
  double highest_elevation_rad = 0.1745;  ///< +10 degrees.
  double min_range_m = 0.5;               ///< Nearer and farther returns are lost.
  double max_range_m = 100;
  double range_sigma_m = 0.02;  ///< Standard deviation of the noise along the ray, >= 0.

  /// @throws InvalidArgument  if a member is out of range.
  void validate() const;
};

/// One sweep over `scene`: the nearest surface along every ray, with noise along the ray, beam by beam. Rays without a
/// return give no point.
Scan cast_scan(std::span<const Rectangle> scene, const Pose& world_from_scan, const SpinningSensor& sensor,
               Random& random);

}  // namespace trysquare
