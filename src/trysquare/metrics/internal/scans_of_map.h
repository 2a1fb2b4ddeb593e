// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"
#include "trysquare/core/registered_map.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trysquare {

/// At most `num_chosen` of the scans 0 .. num_scans − 1, evenly spread, first and last among them; the first for one.
std::vector<std::uint32_t> evenly_spread_scans(std::size_t num_scans, std::size_t num_chosen);

/// @throws InvalidArgument  if a coordinate is not finite, or points and scan indices differ in number.
void require_points_of_scans(const RegisteredMap& map);

/// The points of one scan, map frame [m]. REQUIRES points in scan order, as RegisteredMap has them.
PointsView points_of_scan(const RegisteredMap& map, std::uint32_t scan);

}  // namespace trysquare
