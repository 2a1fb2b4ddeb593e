// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/internal/cluster_tree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace trysquare::internal {

/// Two clusters and their distance. The order is total: of two pairs at the same distance, that with the lower
/// clusters.
struct ClusterPair {
  double squared_distance;
  std::uint32_t lower;
  std::uint32_t higher;

  static ClusterPair of(double squared_distance, std::uint32_t a, std::uint32_t b) {
    return {squared_distance, std::min(a, b), std::max(a, b)};
  }
  bool operator==(const ClusterPair&) const = default;
  bool operator<(const ClusterPair& o) const {
    return std::tie(squared_distance, lower, higher) < std::tie(o.squared_distance, o.lower, o.higher);
  }
};

/// Agglomeration by nearest-neighbor chains: follow nearest neighbors until two clusters are each other's, merge these.
///
/// It makes the merges of the definition, which always takes the least of all pairs, because both linkages are
/// reducible in the order of ClusterPair: a cluster that was made of each other's nearest is no less a pair with a
/// third one than the lesser of the two was. (Its distance is no less; where it is the same, so is its number, the
/// lower of the two.) So a chain stays one of nearest neighbors when its end merges, and a cluster with no other below
/// the limit is final.
///
/// Linkage: size, place, lower_bound, squared_distance, merge; see CompleteLinkage.
/// Source: Murtagh 1983; Müllner 2011, "Modern hierarchical, agglomerative clustering algorithms".
template <class Linkage>
class NearestNeighborChain {
 public:
  /// @param squared_limit  Pairs at this distance do not merge, nor do farther ones.
  NearestNeighborChain(Linkage linkage, double squared_limit)
      : linkage_(std::move(linkage)),
        squared_limit_(squared_limit),
        tree_(places_of(linkage_)),
        merged_into_(linkage_.size()),
        is_done_(linkage_.size()),
        is_on_chain_(linkage_.size()) {
    std::iota(merged_into_.begin(), merged_into_.end(), std::uint32_t{0});
  }

  /// @return  For every point the cluster it was merged into, which has the number of its first point: never above it.
  std::vector<std::uint32_t> run() {
    for (std::uint32_t first = 0; first < linkage_.size(); ++first) {
      while (!is_done_[first]) {
        push({first, nothing()});
        while (!chain_.empty()) step();
      }
    }
    for (std::uint32_t& cluster : merged_into_) cluster = merged_into_[cluster];
    return std::move(merged_into_);
  }

 private:
  struct Link {
    std::uint32_t cluster;
    ClusterPair with_previous;
  };

  /// Every pair below the limit is less.
  ClusterPair nothing() const { return {squared_limit_, 0, 0}; }

  static std::vector<ClusterPlace> places_of(const Linkage& linkage) {
    std::vector<ClusterPlace> places;
    places.reserve(linkage.size());
    for (std::uint32_t cluster = 0; cluster < linkage.size(); ++cluster) places.push_back(linkage.place(cluster));
    return places;
  }

  void step() {
    const Link top = chain_.back();
    const ClusterPair nearest = nearest_pair(top);
    if (nearest == nothing()) {
      retire(top.cluster);
      pop();
    } else if (nearest == top.with_previous) {
      pop();
      pop();
      merge(nearest.lower, nearest.higher);
    } else {
      const std::uint32_t next = nearest.lower == top.cluster ? nearest.higher : nearest.lower;
      // Rounding of Ward's distances may break a tie against reducibility. Then the chain meets itself, and goes on
      // from there: its links grow shorter all the same, so it ends.
      while (is_on_chain_[next] && chain_.back().cluster != next) pop();
      if (!is_on_chain_[next]) push({next, nearest});
    }
  }

  /// The least pair of this cluster; that with its predecessor is known.
  ClusterPair nearest_pair(const Link& link) {
    ClusterPair nearest = link.with_previous;
    tree_.visit_near(
        nearest.squared_distance,
        [&](const ClusterRegion& region) { return linkage_.lower_bound(link.cluster, region); },
        [&](std::uint32_t other) {
          if (other == link.cluster) return nearest.squared_distance;
          const double squared_distance = linkage_.squared_distance(link.cluster, other, nearest.squared_distance);
          nearest = std::min(nearest, ClusterPair::of(squared_distance, link.cluster, other));
          return nearest.squared_distance;
        });
    return nearest;
  }

  void merge(std::uint32_t kept, std::uint32_t gone) {
    linkage_.merge(kept, gone);
    merged_into_[gone] = kept;
    retire(gone);
    tree_.move(kept, linkage_.place(kept));
  }

  void retire(std::uint32_t cluster) {
    is_done_[cluster] = true;
    tree_.remove(cluster);
  }

  void push(const Link& link) {
    chain_.push_back(link);
    is_on_chain_[link.cluster] = true;
  }

  void pop() {
    is_on_chain_[chain_.back().cluster] = false;
    chain_.pop_back();
  }

  Linkage linkage_;
  double squared_limit_;
  ClusterTree tree_;
  std::vector<std::uint32_t> merged_into_;
  std::vector<bool> is_done_;  ///< Merged into another one, or final.
  std::vector<bool> is_on_chain_;
  std::vector<Link> chain_;
};

}  // namespace trysquare::internal
