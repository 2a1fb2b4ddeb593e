// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/metric_result.h"

#include <fmt/format.h>

namespace trysquare {

std::string why_undefined(std::size_t num_queries, const PointSupport& support) {
  if (num_queries == 0) return "there are no query points";
  return fmt::format("no query point has a value: of {}, {} have too few neighbors and {} lie exactly in a plane",
                     num_queries, support.num_too_few, support.num_degenerate);
}

}  // namespace trysquare
