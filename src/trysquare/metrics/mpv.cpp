// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/mpv.h"

#include "trysquare/stats/mean.h"

namespace trysquare {

MetricResult mpv(const PointStatistics& points) {
  const PointSupport& support = points.plane_variance_support;
  MetricResult result{.value = mean_of_defined(points.plane_variances),
                      .num_queries = points.size(),
                      .num_used = support.num_defined + support.num_degenerate,
                      .num_degenerate = support.num_degenerate,
                      .num_too_few = support.num_too_few};
  if (!result.value) result.reason = why_undefined(points.size(), support);
  return result;
}

}  // namespace trysquare
