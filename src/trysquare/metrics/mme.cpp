// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/mme.h"

#include "trysquare/stats/mean.h"

namespace trysquare {

MetricResult mme(const PointStatistics& points, Definition definition) {
  const PointSupport& support = points.entropy_support;
  MetricResult result{.value = mean_of_defined(points.entropies),
                      .num_queries = points.size(),
                      .num_used = support.num_defined,
                      .num_degenerate = support.num_degenerate,
                      .num_too_few = support.num_too_few};
  if (!result.value) {
    result.reason = why_undefined(points.size(), support);
  } else if (definition == Definition::kAisBonn) {  // its mean is over all points, the undefined ones as 0
    *result.value *= static_cast<double>(support.num_defined) / static_cast<double>(points.size());
  }
  return result;
}

}  // namespace trysquare
