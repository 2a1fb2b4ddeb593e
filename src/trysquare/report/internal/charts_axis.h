// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/report/internal/svg.h"

#include <string>
#include <vector>

namespace trysquare::internal {

/// Maps the numbers [low, high] of an axis to places of the figure.
struct AxisScale {
  double low = 0;
  double high = 1;
  double place_of_low = 0;
  double place_of_high = 1;

  double place(double value) const {
    return place_of_low + (value - low) / (high - low) * (place_of_high - place_of_low);
  }
};

/// Round numbers (1, 2 or 5 times a power of ten apart) in [low, high], about `num_wanted` of them. REQUIRES: low <
/// high.
struct Ticks {
  double step = 1;
  std::vector<double> values;
};
Ticks ticks(double low, double high, double num_wanted);

/// As ticks(), but one apart at least: for numbers of scans.
Ticks whole_ticks(double low, double high, double num_wanted);

/// Vertical grid lines with numbers below the box, horizontal ones with numbers to its left.
std::string x_axis(const AxisScale& scale, const Ticks& marks, const SvgBox& box, bool with_grid);
std::string y_axis(const AxisScale& scale, const Ticks& marks, const SvgBox& box);

}  // namespace trysquare::internal
