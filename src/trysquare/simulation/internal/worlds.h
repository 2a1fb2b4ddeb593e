// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/simulation/simulated_world.h"
#include "trysquare/synthetic/random.h"

namespace trysquare::internal {

/// The builders behind make_world(), one for each kind of world.
SimulatedWorld street_world(const WorldSettings& settings, Random& random);
SimulatedWorld town_world(WorldStyle style, const WorldSettings& settings, Random& random);
SimulatedWorld room_world(Random& random);
SimulatedWorld office_world(Random& random);

}  // namespace trysquare::internal
