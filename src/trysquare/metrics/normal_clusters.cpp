// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/normal_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace trysquare {
namespace {

double sign_free_distance(const Eigen::Vector3d& n, const Eigen::Vector3d& m) {
  return std::sqrt(std::min((n - m).squaredNorm(), (n + m).squaredNorm()));
}

/// Distances of all pairs of clusters, half of the symmetric matrix.
class PairDistances {
 public:
  explicit PairDistances(PointsView normals) : distances_(normals.size() * (normals.size() + 1) / 2) {
    for (std::size_t i = 0; i < normals.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) at(i, j) = sign_free_distance(normals[i], normals[j]);
    }
  }
  double& at(std::size_t i, std::size_t j) {
    const auto [low, high] = std::minmax(i, j);
    return distances_[high * (high + 1) / 2 + low];
  }

 private:
  std::vector<double> distances_;
};

/// Nearest-neighbor chain: follow nearest neighbors until two clusters are each other's, and merge these. Complete
/// linkage is reducible, so this makes the same merges as always taking the globally nearest pair.
class CompleteLinkage {
 public:
  CompleteLinkage(PointsView normals, double cut)
      : cut_(cut), distances_(normals), active_(normals.size()), parent_(normals.size()) {
    std::iota(active_.begin(), active_.end(), std::size_t{0});
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  std::vector<std::uint32_t> run() {
    std::vector<std::size_t> chain;
    while (!active_.empty()) {
      if (chain.empty()) chain.push_back(active_.back());
      const std::size_t top = chain.back();
      const std::size_t previous = chain.size() >= 2 ? chain[chain.size() - 2] : top;
      const std::size_t nearest = nearest_below_cut(top, previous);
      if (nearest == top) {  // nothing in reach now, and merges only move clusters apart: this one is final
        std::erase(active_, top);
        chain.pop_back();
      } else if (chain.size() >= 2 && nearest == previous) {
        chain.resize(chain.size() - 2);
        merge(std::min(top, nearest), std::max(top, nearest));
      } else {
        chain.push_back(nearest);
      }
    }
    return labels();
  }

 private:
  /// `cluster` itself when no other is below the cut. On a tie the chain turns back, or else it could run in circles.
  std::size_t nearest_below_cut(std::size_t cluster, std::size_t previous) {
    std::size_t nearest = cluster;
    double least = cut_;
    if (previous != cluster && distances_.at(cluster, previous) < cut_) {
      nearest = previous;
      least = distances_.at(cluster, previous);
    }
    for (const std::size_t other : active_) {
      if (other != cluster && distances_.at(cluster, other) < least) {
        nearest = other;
        least = distances_.at(cluster, other);
      }
    }
    return nearest;
  }

  void merge(std::size_t kept, std::size_t gone) {
    parent_[gone] = kept;
    std::erase(active_, gone);
    for (const std::size_t other : active_) {
      if (other != kept) distances_.at(kept, other) = std::max(distances_.at(kept, other), distances_.at(gone, other));
    }
  }

  std::vector<std::uint32_t> labels() const {
    std::vector<std::uint32_t> label_of_root(parent_.size(), std::numeric_limits<std::uint32_t>::max());
    std::vector<std::uint32_t> result(parent_.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) {
      std::size_t root = i;
      while (parent_[root] != root) root = parent_[root];
      if (label_of_root[root] == std::numeric_limits<std::uint32_t>::max()) label_of_root[root] = next++;
      result[i] = label_of_root[root];
    }
    return result;
  }

  double cut_;
  PairDistances distances_;
  std::vector<std::size_t> active_;
  std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<std::uint32_t> cluster_normals(PointsView normals, double cut) {
  return CompleteLinkage(normals, cut).run();
}

}  // namespace trysquare
