// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/orthogonal_clique.h"

#include "trysquare/metrics/internal/canonical_sign.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace trysquare {
namespace {

/// Clusters sorted by size, largest first, so that the first clique found among equals has the largest members. Equal
/// sizes are ordered by their normals, so that the order of the input decides nothing.
std::vector<std::size_t> largest_first(std::span<const NormalCluster> clusters) {
  std::vector<std::size_t> order(clusters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    const Eigen::Vector3d normal = with_canonical_sign(clusters[i].normal);
    return std::tuple(-static_cast<double>(clusters[i].num_points), normal.x(), normal.y(), normal.z());
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

struct Clique {
  std::vector<std::size_t> members;
  std::size_t num_points = 0;

  void improve_to(std::vector<std::size_t> other, std::span<const NormalCluster> clusters) {
    std::size_t points = 0;
    for (const std::size_t member : other) points += clusters[member].num_points;
    if (std::tuple(other.size(), points) <= std::tuple(members.size(), num_points)) return;
    members = std::move(other);
    num_points = points;
  }
};

}  // namespace

std::vector<std::size_t> largest_orthogonal_clique(std::span<const NormalCluster> clusters,
                                                   double orthogonality_bound) {
  const std::vector<std::size_t> order = largest_first(clusters);
  const auto orthogonal = [&](std::size_t i, std::size_t j) {
    return std::abs(clusters[i].normal.dot(clusters[j].normal)) < orthogonality_bound;
  };
  Clique best;
  for (std::size_t a = 0; a < order.size(); ++a) {
    best.improve_to({order[a]}, clusters);
    std::vector<std::size_t> neighbors;
    std::copy_if(order.begin() + static_cast<std::ptrdiff_t>(a) + 1, order.end(), std::back_inserter(neighbors),
                 [&](std::size_t other) { return orthogonal(order[a], other); });
    for (std::size_t b = 0; b < neighbors.size(); ++b) {
      best.improve_to({order[a], neighbors[b]}, clusters);
      const auto third = std::find_if(neighbors.begin() + static_cast<std::ptrdiff_t>(b) + 1, neighbors.end(),
                                      [&](std::size_t other) { return orthogonal(neighbors[b], other); });
      if (third != neighbors.end()) best.improve_to({order[a], neighbors[b], *third}, clusters);
    }
  }
  return best.members;
}

}  // namespace trysquare
