// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/internal/cluster_box.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace trysquare::internal {

/// Where a cluster is, and how many points it has.
struct ClusterPlace {
  Eigen::Vector3d position;
  double count;
};

/// Where some clusters are, and the least of their counts.
struct ClusterRegion {
  ClusterBox positions;
  double least_count = std::numeric_limits<std::uint32_t>::max();  ///< No cluster has more points.
};

/// Where the clusters are that may still merge: a balanced tree of regions.
/// It is divided once; removing or moving a cluster only refits the regions from its leaf to the root.
/// Cost: about 60 bytes a cluster, O(log N) to remove or move one.
class ClusterTree {
 public:
  /// @param places  Of clusters 0 to N − 1, at least one.
  explicit ClusterTree(std::vector<ClusterPlace> places);

  void remove(std::uint32_t cluster);
  void move(std::uint32_t cluster, const ClusterPlace& place);

  /// Calls `visit` for every cluster of leaves that are in reach, near ones first.
  /// @param lower_bound  double(const ClusterRegion&): no cluster in the region is nearer (squared).
  /// @param visit        double(cluster): the squared reach from here on; regions that are farther are passed over.
  template <class LowerBound, class Visit>
  void visit_near(double squared_reach, const LowerBound& lower_bound, const Visit& visit) const {
    std::array<std::pair<std::uint32_t, double>, kMaxDepth> stack;  // nodes yet to be seen, with their bounds
    std::size_t num_waiting = 0;
    stack[num_waiting++] = {1, 0.0};
    while (num_waiting > 0) {
      const auto [node, bound] = stack[--num_waiting];
      if (bound > squared_reach) continue;
      if (node >= first_leaf_) {
        for (const std::uint32_t cluster : clusters_of(node)) squared_reach = visit(cluster);
        continue;
      }
      std::pair<std::uint32_t, double> near{2 * node, lower_bound(regions_[2 * node])};
      std::pair<std::uint32_t, double> far{2 * node + 1, lower_bound(regions_[2 * node + 1])};
      if (far.second < near.second) std::swap(near, far);
      if (far.second <= squared_reach) stack[num_waiting++] = far;
      if (near.second <= squared_reach) stack[num_waiting++] = near;
    }
  }

 private:
  static constexpr std::size_t kMaxDepth = 40;  ///< More than the levels of a tree over 2^32 clusters.

  /// The leaves' clusters, in the tree's order; `node` is at any level.
  std::pair<std::size_t, std::size_t> range_of(std::uint32_t node) const;
  std::span<const std::uint32_t> clusters_of(std::uint32_t leaf) const;
  void divide(std::uint32_t node);
  void refit_leaf(std::uint32_t leaf);
  void refit_from(std::uint32_t leaf);

  std::vector<ClusterPlace> places_;
  std::uint32_t first_leaf_;             ///< Node 1 is the root, node i has the children 2i and 2i + 1.
  std::vector<ClusterRegion> regions_;   ///< Of every node; empty when all its clusters are gone.
  std::vector<std::uint32_t> order_;     ///< Clusters, leaf by leaf; in each leaf those that are gone come last.
  std::vector<std::uint32_t> num_left_;  ///< Clusters of every leaf that are not gone.
  std::vector<std::uint32_t> leaf_of_;   ///< Of every cluster.
};

}  // namespace trysquare::internal
