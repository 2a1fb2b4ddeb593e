// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"

#include <cstddef>

namespace trysquare {

/// How many points equal an earlier one exactly, in all three coordinates. Duplicates fill up neighborhoods without
/// telling anything: ten copies of three points pass any least number of neighbors, with a plane variance of 0.
/// Cost: O(N log N) time, a copy of the points.
std::size_t count_exact_duplicates(PointsView points);

}  // namespace trysquare
