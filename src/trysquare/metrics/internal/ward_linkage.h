// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"
#include "trysquare/metrics/internal/cluster_tree.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trysquare::internal {

/// Ward's linkage: clusters of a and b points with the centroids A and B are √(2ab / (a + b)) · |A − B| apart.
/// Of two points that is their distance. Source: Ward 1963, in the scale of scipy and scikit-learn.
/// Cost: 56 bytes a point.
class WardLinkage {
 public:
  /// @param counts  How many points stand at each of `points`; same length.
  WardLinkage(PointsView points, const std::vector<std::uint32_t>& counts);

  std::size_t size() const { return sums_.size(); }

  /// Its centroid.
  const ClusterPlace& place(std::uint32_t cluster) const { return places_[cluster]; }

  /// No cluster in the region is nearer (squared).
  double lower_bound(std::uint32_t cluster, const ClusterRegion& region) const;

  double squared_distance(std::uint32_t a, std::uint32_t b, double stop_above) const;

  void merge(std::uint32_t kept, std::uint32_t gone);

 private:
  std::vector<ClusterPlace> places_;
  std::vector<Eigen::Vector3d> sums_;
};

}  // namespace trysquare::internal
