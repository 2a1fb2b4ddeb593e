// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/overlap.h"

#include <cmath>

namespace trysquare {

Overlap overlap(const PointStatistics& points) {
  Overlap result;
  double sum_of_neighbors = 0;
  double sum_of_scans = 0;
  std::size_t num_multi_scan = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum_of_neighbors += points.num_neighbors[i];
    if (std::isnan(points.plane_variances[i])) continue;
    ++result.num_neighborhoods;
    sum_of_scans += points.num_scans[i];
    if (points.num_scans[i] >= 2) ++num_multi_scan;
  }
  if (points.size() > 0) result.neighbors_mean = sum_of_neighbors / static_cast<double>(points.size());
  if (result.num_neighborhoods == 0) return result;
  const auto num_used = static_cast<double>(result.num_neighborhoods);
  result.scans_per_neighborhood_mean = sum_of_scans / num_used;
  result.multi_scan_share = static_cast<double>(num_multi_scan) / num_used;
  result.line_like_share = static_cast<double>(points.num_line_like) / num_used;
  return result;
}

}  // namespace trysquare
