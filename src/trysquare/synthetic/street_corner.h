// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/synthetic/memory_scans.h"
#include "trysquare/synthetic/rectangle.h"
#include "trysquare/synthetic/spinning_sensor.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trysquare {

/// A sequence whose true poses are known.
struct SyntheticSequence {
  MemoryScans scans;
  Trajectory trajectory;  ///< True poses, the first at the origin; a stamp every 0.1 s.
};

/// A drive towards a street corner.
struct StreetCornerSettings {
  std::size_t num_scans = 20;       ///< >= 1
  double step_m = 0.8;              ///< Way between two scans, > 0.
  double turn_per_step_rad = 0.01;  ///< To the left, a gentle curve.
  SpinningSensor sensor{};
  std::uint64_t seed = 0;

  /// @throws InvalidArgument  if a member is out of range.
  void validate() const;
};

/// The rectangles of the street: the ground, facades on both sides, the facade of the street that crosses ahead, and
/// two parked cars, in the frame of the first scan (x ahead, y left, z up, the ground 1.8 m below).
std::vector<Rectangle> street_corner_scene();

/// Scans of street_corner_scene() from a sensor that drives along it. The same settings give the same points on every
/// platform whose mathematics library rounds alike. Three directions at right angles, so every metric has a value.
///
/// Cost:  about 10 ms a scan of 23,000 rays.
SyntheticSequence simulate_street_corner(const StreetCornerSettings& settings);

}  // namespace trysquare
