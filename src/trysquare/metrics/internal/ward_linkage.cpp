// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/internal/ward_linkage.h"

namespace trysquare::internal {
namespace {

double factor(double a, double b) { return 2 * (a * b) / (a + b); }

}  // namespace

WardLinkage::WardLinkage(PointsView points, const std::vector<std::uint32_t>& counts) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    places_.push_back({points[i], static_cast<double>(counts[i])});
    sums_.emplace_back(points[i] * places_[i].count);
  }
}

double WardLinkage::lower_bound(std::uint32_t cluster, const ClusterRegion& region) const {
  const ClusterPlace& place = places_[cluster];
  return factor(place.count, region.least_count) * least_squared_distance(box_of(place.position), region.positions);
}

double WardLinkage::squared_distance(std::uint32_t a, std::uint32_t b, double /*stop_above*/) const {
  return factor(places_[a].count, places_[b].count) *
         internal::squared_distance(places_[a].position, places_[b].position);
}

void WardLinkage::merge(std::uint32_t kept, std::uint32_t gone) {
  sums_[kept] += sums_[gone];
  places_[kept].count += places_[gone].count;
  places_[kept].position = sums_[kept] / places_[kept].count;
}

}  // namespace trysquare::internal
