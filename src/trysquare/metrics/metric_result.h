// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/point_statistics.h"

#include <cstddef>
#include <optional>
#include <string>

namespace trysquare {

/// One metric of the map, with what it rests on. num_queries = num_used + num_degenerate + num_too_few, except that
/// MPV uses degenerate points too (as 0) and so counts them in num_used as well.
struct MetricResult {
  std::optional<double> value;  ///< Empty when the metric is undefined, never 0 for that.
  std::string reason;           ///< Why `value` is empty; empty otherwise.
  std::size_t num_queries = 0;
  std::size_t num_used = 0;        ///< Points that entered `value`.
  std::size_t num_degenerate = 0;  ///< Enough neighbors, but exactly planar or less: λ₁ <= 1e-12 λ₃.
  std::size_t num_too_few = 0;     ///< Fewer than the least number of neighbors.
};

/// The `reason` of a metric without a value.
std::string why_undefined(std::size_t num_queries, const PointSupport& support);

}  // namespace trysquare
