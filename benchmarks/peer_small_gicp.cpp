// SPDX-License-Identifier: Apache-2.0
#include "neighborhood_values.h"
#include "peers.h"
#include <small_gicp/ann/kdtree.hpp>
#include <small_gicp/points/eigen.hpp>

#include <iostream>  // its headers use it without including it
#include <limits>
#include <vector>

namespace trysquare::bench {
namespace {

using Points = std::vector<Eigen::Vector4d>;  // what its own point clouds hold: x, y, z, 1
using Tree = small_gicp::UnsafeKdTree<Points>;

/// Collects the points with d < radius, by the same test in the same order as the definition.
void points_within(const Tree& tree, const Eigen::Vector4d& query, double squared_radius,
                   std::vector<small_gicp::NodeIndexType>& to_visit, std::vector<std::size_t>& found) {
  found.clear();
  to_visit.assign(1, tree.root);
  while (!to_visit.empty()) {
    const auto& node = tree.nodes[to_visit.back()];
    to_visit.pop_back();
    if (node.left == small_gicp::INVALID_NODE) {
      for (std::size_t i = node.node_type.lr.first; i < node.node_type.lr.last; ++i) {
        const Eigen::Vector4d d = tree.points[tree.indices[i]] - query;
        if ((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2] < squared_radius) found.push_back(tree.indices[i]);
      }
      continue;
    }
    const double beyond_threshold = node.node_type.sub.proj(query) - node.node_type.sub.thresh;
    const bool reaches_both = beyond_threshold * beyond_threshold < squared_radius;
    if (reaches_both || beyond_threshold >= 0) to_visit.push_back(node.right);
    if (reaches_both || beyond_threshold < 0) to_visit.push_back(node.left);
  }
}

}  // namespace

Outcome run_small_gicp(const Problem& problem) {
  Outcome outcome;
  const Stopwatch build;
  Points points;
  points.reserve(problem.points_in_map.size());
  for (const Eigen::Vector3d& point : problem.points_in_map) points.push_back(point.homogeneous());
  const Tree tree(points);
  outcome.build = build.elapsed();

  const Stopwatch query;
  NeighborhoodValues values;
  std::vector<small_gicp::NodeIndexType> to_visit;
  std::vector<std::size_t> found;
  const auto point_of = [&](std::size_t i) -> const Eigen::Vector3d& { return problem.points_in_map[i]; };
  for (const Eigen::Vector3d& point : problem.queries_in_map()) {
    points_within(tree, point.homogeneous(), problem.radius_m * problem.radius_m, to_visit, found);
    outcome.neighbors_sum += found.size();
    if (found.size() >= NeighborhoodValues::kMinNeighbors) values.add(covariance_of(found, point_of));
  }
  values.put_into(outcome);
  outcome.query = query.elapsed();
  return outcome;
}

}  // namespace trysquare::bench
