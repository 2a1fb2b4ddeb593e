// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/internal/complete_linkage.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace trysquare::internal {
namespace {

/// Lower bound for the distance of the farthest pair of the set that `a` bounds and any set with a point in `b`.
double farthest_at_least(const ClusterBox& a, const ClusterBox& b) {
  return std::max(least_squared_distance(a, b), least_squared_reach(a, b));
}

/// The same where n and −n are one. A member that is far from a point is far in the sense of signs if it is also far
/// from its mirror image; which sign the bounds come from does not matter.
double farthest_at_least_sign_free(const ClusterBox& a, const ClusterBox& b) {
  const ClusterBox mirror = mirrored(b);
  const double gap = least_squared_distance(a, b);
  const double mirror_gap = least_squared_distance(a, mirror);
  return std::max({std::min(gap, mirror_gap), std::min(least_squared_reach(a, b), mirror_gap),
                   std::min(least_squared_reach(a, mirror), gap)});
}

}  // namespace

CompleteLinkage::CompleteLinkage(PointsView points, bool sign_free) : sign_free_(sign_free), root_of_(points.size()) {
  nodes_.reserve(2 * points.size());
  for (const Eigen::Vector3d& point : points) nodes_.push_back({box_of(point)});
  std::iota(root_of_.begin(), root_of_.end(), std::uint32_t{0});
}

double CompleteLinkage::lower_bound(std::uint32_t cluster, const ClusterBox& first_members) const {
  const ClusterBox& box = nodes_[root_of_[cluster]].box;
  return sign_free_ ? farthest_at_least_sign_free(box, first_members) : farthest_at_least(box, first_members);
}

double CompleteLinkage::squared_distance(std::uint32_t a, std::uint32_t b, double stop_above) {
  const double least = std::max(lower_bound(a, box_of(first_member(b))), lower_bound(b, box_of(first_member(a))));
  if (least > stop_above) return least;
  double greatest = 0;
  to_search_.assign(1, pair_of(root_of_[a], root_of_[b]));
  while (!to_search_.empty() && greatest <= stop_above) {
    const PairOfNodes pair = to_search_.back();
    to_search_.pop_back();
    if (pair.upper_bound <= greatest) continue;
    if (is_point(pair.a) && is_point(pair.b)) {
      greatest = pair.upper_bound;
      continue;
    }
    const bool divides_a = !is_point(pair.a) && (is_point(pair.b) || squared_diagonal(nodes_[pair.a].box) >=
                                                                         squared_diagonal(nodes_[pair.b].box));
    const Node& divided = nodes_[divides_a ? pair.a : pair.b];
    const std::uint32_t other = divides_a ? pair.b : pair.a;
    PairOfNodes near = pair_of(divided.left, other);
    PairOfNodes far = pair_of(divided.right, other);
    if (far.upper_bound < near.upper_bound) std::swap(near, far);
    if (near.upper_bound > greatest) to_search_.push_back(near);
    if (far.upper_bound > greatest) to_search_.push_back(far);
  }
  return greatest;
}

void CompleteLinkage::merge(std::uint32_t kept, std::uint32_t gone) {
  const ClusterBox& box = nodes_[root_of_[kept]].box;
  const ClusterBox& other = nodes_[root_of_[gone]].box;
  ClusterBox both = united(box, other);
  if (sign_free_) {
    const ClusterBox both_mirrored = united(box, mirrored(other));
    if (squared_diagonal(both_mirrored) < squared_diagonal(both)) both = both_mirrored;
  }
  nodes_.push_back({both, root_of_[kept], root_of_[gone]});
  root_of_[kept] = static_cast<std::uint32_t>(nodes_.size() - 1);
}

CompleteLinkage::PairOfNodes CompleteLinkage::pair_of(std::uint32_t a, std::uint32_t b) const {
  const ClusterBox& box = nodes_[a].box;
  const ClusterBox& other = nodes_[b].box;
  double upper_bound = greatest_squared_distance(box, other);
  if (sign_free_) upper_bound = std::min(upper_bound, greatest_squared_distance(box, mirrored(other)));
  return {a, b, upper_bound};
}

}  // namespace trysquare::internal
