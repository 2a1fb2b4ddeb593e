// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/report/internal/json.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trysquare::internal {

/// Consecutive scans [first, last].
struct Window {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// One quantity over the windows.
struct WindowSeries {
  std::string key;              ///< For file names: "mom", "mpv", "mme", "omme", "rpe", "overlap".
  std::string name;             ///< For people: "MOM".
  std::string unit;             ///< As in the JSON: "m2", "nats", "m"; "scans" for the overlap.
  bool starts_at_zero = false;  ///< The axis of the quantity begins at zero.
  std::vector<std::optional<double>> values;
  std::vector<std::string> reasons;  ///< Why a value is empty.
  std::vector<bool> is_limited;      ///< The value exists but does not follow the trajectory error (MOM, OMME).
};

struct WindowTable {
  std::vector<Window> windows;
  std::vector<WindowSeries> series;  ///< Those that were asked for and could be had, in the order of the report.
};

/// @throws InvalidArgument  if a window ends before it begins.
WindowTable window_table(const Json& evaluation);

bool has_value(const WindowSeries& series);

/// "scans 0–9".
std::string window_label(const Window& window);

/// Unit and factor that keep the labels of an axis short: "10⁻³ m²" and 1000 for values of some thousandths.
struct AxisUnit {
  double factor = 1;
  std::string label;
};
AxisUnit axis_unit(const WindowSeries& series);

}  // namespace trysquare::internal
