// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/quantile.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace trysquare {

double quantile_of_sorted(std::span<const double> sorted, double q) {
  if (sorted.empty()) throw InvalidArgument("sorted is empty: quantiles need at least one value");
  if (!(q >= 0 && q <= 1)) throw InvalidArgument(fmt::format("q = {} is out of range: it must be in [0, 1]", q));
  const double rank = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], rank - static_cast<double>(below));
}

}  // namespace trysquare
