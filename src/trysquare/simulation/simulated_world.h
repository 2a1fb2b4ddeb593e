// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/triangle_mesh.h"
#include "trysquare/simulation/moving_object.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace trysquare {

/// Characters of worlds that make_world() builds.
enum class WorldStyle {
  kStreet,      ///< A straight street: buildings with gaps, some askew, cars, poles, foliage, a wall at either end.
  kTownGrid,    ///< Blocks of tall buildings at right angles.
  kTownSuburb,  ///< Houses with pitched roofs in gardens, hedges, trees.
  kTownOld,     ///< Narrow streets that bend, crooked walls without gaps, on a hillside.
  kRoom,        ///< One furnished room.
  kOffice,      ///< A floor with rooms, desks and a corridor around them.
};

/// What else there is to choose.
struct WorldSettings {
  double street_length_m = 60;  ///< Route of kStreet, >= 10; the others have theirs.
  int num_moving_cars = 0;      ///< On the streets, >= 0. Rooms have none.

  /// @throws InvalidArgument  if a member is out of range.
  void validate() const;
};

/// Surfaces, things that move among them, and a way through them.
struct SimulatedWorld {
  TriangleMesh mesh;                              ///< What stands still.
  std::vector<MovingObject> moving{};             ///< What does not.
  std::vector<Eigen::Vector3d> route_in_world{};  ///< Where a sensor is carried: a polyline [m].
  bool route_is_loop = false;                     ///< From the last point of the route back to the first.
};

/// A world drawn at random. The same style, seed and settings give the same bits; moving cars change nothing else.
/// Foliage is clutter of small triangles in all directions; walls and ground are planes.
///
/// @throws InvalidArgument  if a setting is out of range.
/// Source:  kStreet follows the street for which the accuracy of the estimate of RPE was measured.
SimulatedWorld make_world(WorldStyle style, std::uint64_t seed, const WorldSettings& settings = {});

}  // namespace trysquare
