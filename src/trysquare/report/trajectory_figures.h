// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/report/evaluation_figures.h"
#include "trysquare/trajectory/error_series.h"
#include "trysquare/trajectory/trajectory_errors.h"

#include <vector>

namespace trysquare {

/// Pictures of APE or RPE: `error_map.svg`, the estimate over the reference in the plane of the two largest extents,
/// colored by error; `error_over_distance.svg`; and with time stamps `error_over_time.svg`. Series of more than 400
/// values are drawn as the smallest and largest of each of 400 parts, so that no peak is lost and the files stay small;
/// on the map, places less than a fifth of a unit apart are one. REQUIRES: errors that are not empty.
std::vector<Figure> error_figures(const TrajectoryErrors& errors, const ErrorSeries& series,
                                  const Trajectory& reference);

}  // namespace trysquare
