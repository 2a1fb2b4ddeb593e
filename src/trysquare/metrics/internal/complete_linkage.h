// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"
#include "trysquare/metrics/internal/cluster_box.h"
#include "trysquare/metrics/internal/cluster_tree.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trysquare::internal {

/// Complete linkage: two clusters are as far apart as their farthest members.
///
/// Every cluster is the binary tree of its merges, with a box at each node. The farthest pair of two clusters is
/// searched in both trees at once, passing over pairs of boxes that cannot hold a farther one: the maximum over all
/// pairs of members, to the last bit, without looking at most of them. Signs, where they are free, are never chosen:
/// each bound is taken for both, so that no boundary between the signs exists. Cost: 116 bytes a point.
class CompleteLinkage {
 public:
  CompleteLinkage(PointsView points, bool sign_free);

  std::size_t size() const { return root_of_.size(); }

  /// Its first member, which stays when others merge into it; counts play no part.
  ClusterPlace place(std::uint32_t cluster) const { return {first_member(cluster), 1}; }

  /// No cluster in the region is nearer (squared).
  double lower_bound(std::uint32_t cluster, const ClusterRegion& region) const {
    return lower_bound(cluster, region.positions);
  }

  /// Squared; of distances above `stop_above` only that they are.
  double squared_distance(std::uint32_t a, std::uint32_t b, double stop_above);

  void merge(std::uint32_t kept, std::uint32_t gone);

 private:
  struct Node {  ///< The first N are the points, with themselves as their box.
    ClusterBox box;
    std::uint32_t left = 0;
    std::uint32_t right = 0;
  };
  struct PairOfNodes {
    std::uint32_t a;
    std::uint32_t b;
    double upper_bound;  ///< No member of a is farther from one of b (squared); of two points the distance itself.
  };

  const Eigen::Vector3d& first_member(std::uint32_t cluster) const { return nodes_[cluster].box.low; }
  double lower_bound(std::uint32_t cluster, const ClusterBox& first_members) const;
  bool is_point(std::uint32_t node) const { return node < size(); }
  PairOfNodes pair_of(std::uint32_t a, std::uint32_t b) const;

  bool sign_free_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> root_of_;  ///< Node of every cluster.
  std::vector<PairOfNodes> to_search_;
};

}  // namespace trysquare::internal
