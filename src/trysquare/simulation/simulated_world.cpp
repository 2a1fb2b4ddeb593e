// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/simulated_world.h"

#include "trysquare/simulation/internal/require.h"
#include "trysquare/simulation/internal/worlds.h"
#include "trysquare/synthetic/random.h"

#include <cmath>

namespace trysquare {

void WorldSettings::validate() const {
  using internal::require;
  require(street_length_m >= 10 && std::isfinite(street_length_m), "street_length_m", street_length_m, ">= 10");
  require(num_moving_cars >= 0, "num_moving_cars", num_moving_cars, ">= 0");
}

SimulatedWorld make_world(WorldStyle style, std::uint64_t seed, const WorldSettings& settings) {
  constexpr std::uint64_t kWorldStream = 0x776f726c64;  // "world": other numbers than the drive and the noise
  settings.validate();
  Random random(seed, kWorldStream);
  if (style == WorldStyle::kStreet) return internal::street_world(settings, random);
  if (style == WorldStyle::kRoom) return internal::room_world(random);
  if (style == WorldStyle::kOffice) return internal::office_world(random);
  return internal::town_world(style, settings, random);
}

}  // namespace trysquare
