// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/report/internal/json.h"
#include "trysquare/stats/error_statistics.h"

namespace trysquare::internal {

/// Adds evo's seven numbers under evo's names; the unit is said beside them.
void set_statistics(Json& json, const ErrorStatistics& statistics);

/// Statistics of angles in radians, in degrees.
ErrorStatistics in_degrees(const ErrorStatistics& statistics_in_rad);

inline constexpr double kDegreesPerRadian = 57.295779513082320876798154814105;

}  // namespace trysquare::internal
