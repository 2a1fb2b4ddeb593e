// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/report/internal/charts_series.h"
#include "trysquare/report/internal/json.h"
#include "trysquare/report/internal/svg.h"

#include <optional>
#include <vector>

namespace trysquare::internal {

/// Width of every figure: readable on a phone at its natural size, and two of them fit side by side on a desk.
inline constexpr double kFigureWidth = 480;

/// One quantity over the scans: a line through the windows' middles, a grey band and a gap where it is undefined,
/// hollow dots where the value does not follow the trajectory error. REQUIRES: the series has a value.
Drawing window_chart(const std::vector<Window>& windows, const WindowSeries& series);

/// The charts of all series that have a value, one below the other.
Drawing stacked_window_charts(const WindowTable& table);

/// The trajectory, seen along the map axis of its smallest extent, one segment per window in the color of its value;
/// the same scale on both axes; grey and dashed where the value is undefined. Where windows overlap, each colors the
/// part around its middle. Empty when the evaluation has no trajectory. REQUIRES: the series has a value.
/// @throws InvalidArgument  if a window reaches beyond the trajectory.
std::optional<Drawing> heat_map(const Json& evaluation, const std::vector<Window>& windows, const WindowSeries& series);

}  // namespace trysquare::internal
