// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/registered_map.h"
#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"

#include <cstddef>
#include <limits>

namespace trysquare {

/// Which points of which scans make the map.
struct MapSettings {
  std::size_t first_scan = 0;
  std::size_t num_scans = 0;                                     ///< 0: all from first_scan on.
  double min_range_m = 0;                                        ///< Points nearer to the sensor are left out [m].
  double max_range_m = std::numeric_limits<double>::infinity();  ///< Points farther away are left out [m].
  std::size_t keep_every = 1;  ///< Of each scan, the points with index % keep_every == 0; >= 1.

  void validate() const;  ///< @throws InvalidArgument
};

/// A map and what did not get into it.
struct AssembledMap {
  RegisteredMap map;
  std::size_t num_not_finite = 0;
  std::size_t num_at_origin = 0;
  std::size_t num_out_of_range = 0;
};

/// Puts all scans into the frame of the first one: the paper's registered point cloud P.
///
/// map_from_scan[i] = inverse(world_from_scan[0]) · world_from_scan[i] is formed before any point is moved, with the
/// general inverse, so that UTM-sized coordinates never touch a point and the numbers of the file are kept.
///
/// @param scans       Loaded one after the other by several threads; each point in its scan's frame [m].
/// @param trajectory  One pose per scan.
/// @param execution   Threads. The result is bit-identical for every value.
/// @return            Points in scan order, and within a scan in its own order.
/// @throws InvalidArgument  if the numbers of scans and poses differ, a pose is not finite or not a rotation
///                          (rotation_error() >= kRotationErrorLimit), or `settings` is out of range.
/// @throws IoError          from ScanSequence::load().
AssembledMap assemble_map(const ScanSequence& scans, const Trajectory& trajectory, const MapSettings& settings = {},
                          const Execution& execution = {});

}  // namespace trysquare
