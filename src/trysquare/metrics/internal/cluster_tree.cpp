// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/internal/cluster_tree.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace trysquare::internal {
namespace {

constexpr std::size_t kClustersPerLeaf = 8;

ClusterRegion united(const ClusterRegion& a, const ClusterRegion& b) {
  return {internal::united(a.positions, b.positions), std::min(a.least_count, b.least_count)};
}

}  // namespace

ClusterTree::ClusterTree(std::vector<ClusterPlace> places)
    : places_(std::move(places)),
      first_leaf_(static_cast<std::uint32_t>(std::bit_ceil((places_.size() - 1) / kClustersPerLeaf + 1))),
      regions_(2 * std::size_t{first_leaf_}),
      order_(places_.size()),
      num_left_(first_leaf_),
      leaf_of_(places_.size()) {
  std::iota(order_.begin(), order_.end(), std::uint32_t{0});
  for (std::uint32_t node = 1; node < first_leaf_; ++node) divide(node);
  for (std::uint32_t leaf = first_leaf_; leaf < 2 * first_leaf_; ++leaf) {
    const auto [begin, end] = range_of(leaf);
    num_left_[leaf - first_leaf_] = static_cast<std::uint32_t>(end - begin);
    for (const std::uint32_t cluster : clusters_of(leaf)) leaf_of_[cluster] = leaf;
    refit_leaf(leaf);
  }
  for (std::uint32_t node = first_leaf_ - 1; node >= 1; --node) {
    regions_[node] = united(regions_[2 * node], regions_[2 * node + 1]);
  }
}

void ClusterTree::remove(std::uint32_t cluster) {
  const std::uint32_t leaf = leaf_of_[cluster];
  std::uint32_t& num_left = num_left_[leaf - first_leaf_];
  const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(range_of(leaf).first);
  std::iter_swap(std::find(begin, begin + num_left, cluster), begin + (num_left - 1));
  --num_left;
  refit_from(leaf);
}

void ClusterTree::move(std::uint32_t cluster, const ClusterPlace& place) {
  places_[cluster] = place;
  refit_from(leaf_of_[cluster]);
}

std::pair<std::size_t, std::size_t> ClusterTree::range_of(std::uint32_t node) const {
  const std::size_t num_beside = std::bit_floor(node);  // nodes of this level
  const std::size_t place = node - num_beside;
  return {place * places_.size() / num_beside, (place + 1) * places_.size() / num_beside};
}

std::span<const std::uint32_t> ClusterTree::clusters_of(std::uint32_t leaf) const {
  return std::span(order_).subspan(range_of(leaf).first, num_left_[leaf - first_leaf_]);
}

/// Sorts the node's clusters into its two children, along its longest side.
void ClusterTree::divide(std::uint32_t node) {
  const auto [begin, end] = range_of(node);
  const auto clusters = std::span(order_).subspan(begin, end - begin);
  ClusterBox box;
  for (const std::uint32_t cluster : clusters) box = internal::united(box, box_of(places_[cluster].position));
  Eigen::Index axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const auto middle = clusters.begin() + static_cast<std::ptrdiff_t>(range_of(2 * node).second - begin);
  std::nth_element(clusters.begin(), middle, clusters.end(), [&](std::uint32_t a, std::uint32_t b) {
    return places_[a].position[axis] < places_[b].position[axis];
  });
}

void ClusterTree::refit_leaf(std::uint32_t leaf) {
  ClusterRegion region;
  for (const std::uint32_t cluster : clusters_of(leaf)) {
    region = united(region, {box_of(places_[cluster].position), places_[cluster].count});
  }
  regions_[leaf] = region;
}

void ClusterTree::refit_from(std::uint32_t leaf) {
  refit_leaf(leaf);
  for (std::uint32_t node = leaf / 2; node >= 1; node /= 2) {
    regions_[node] = united(regions_[2 * node], regions_[2 * node + 1]);
  }
}

}  // namespace trysquare::internal
