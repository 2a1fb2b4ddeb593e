// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/cluster_subset.h"

#include "trysquare/core/error.h"
#include "trysquare/metrics/internal/one_per_voxel.h"
#include "trysquare/metrics/internal/scans_of_map.h"
#include "trysquare/metrics/nearest_neighbor_normals.h"
#include "trysquare/metrics/orthogonal_clique.h"
#include "trysquare/metrics/planar_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

constexpr int kMinNeighborsOfNormal = 4;

void require(bool in_range, const char* name, double value, const char* range) {
  if (!in_range)
    throw InvalidArgument(fmt::format("orthogonal subset: {} = {} is out of range: it must be {}", name, value, range));
}

/// Planar points of one scan, sorted by coordinates, so that the order in which they came decides nothing.
PlanarPoints planar_points_of(PointsView scan, double radius_m, const ClusterSubsetSettings& settings,
                              const Execution& execution) {
  const std::vector<Eigen::Vector3d> points = one_per_voxel(scan, 0);
  PlanarPoints planar = planar_points(PointIndex(points, execution), points,
                                      {.radius_m = radius_m, .min_neighbors = kMinNeighborsOfNormal},
                                      settings.planarity_ratio, execution);
  if (settings.num_nearest) {
    planar.normals = nearest_neighbor_normals(points, planar.points, radius_m, *settings.num_nearest, execution);
  }
  return planar;
}

struct Cluster {
  NormalCluster summary;
  std::vector<std::size_t> members;  ///< Indices of planar points.
};

/// Mean of the normals of a cluster, which agree up to sign when they have none.
Eigen::Vector3d mean_normal(const std::vector<Eigen::Vector3d>& normals, const std::vector<std::size_t>& members) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& first = normals[members.front()];
  for (const std::size_t member : members) sum += normals[member].dot(first) < 0 ? -normals[member] : normals[member];
  return sum.normalized();
}

std::vector<Cluster> large_clusters(const PlanarPoints& planar, const ClusterSubsetSettings& settings) {
  const std::vector<std::uint32_t> labels = cluster_normals(
      planar.normals,
      {.linkage = settings.linkage, .cut = settings.linkage_cut, .sign_free = settings.linkage == Linkage::kComplete});
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == clusters.size()) clusters.emplace_back();
    clusters[labels[i]].members.push_back(i);
  }
  std::erase_if(clusters, [&](const Cluster& cluster) { return cluster.members.size() < settings.min_cluster_size; });
  for (Cluster& cluster : clusters) {
    cluster.summary = {mean_normal(planar.normals, cluster.members), cluster.members.size()};
  }
  return clusters;
}

/// The points of one cluster of the clique and of every cluster co-linear with it, and with no other one more so.
OrthogonalSubset::Direction direction_around(std::size_t chosen, const std::vector<std::size_t>& clique,
                                             const std::vector<Cluster>& clusters, const PlanarPoints& planar,
                                             const ClusterSubsetSettings& settings) {
  OrthogonalSubset::Direction direction{.normal_in_map = clusters[chosen].summary.normal};
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const auto cosine = [&](std::size_t other) {
      return std::abs(clusters[i].summary.normal.dot(clusters[other].summary.normal));
    };
    const bool is_nearest =
        std::none_of(clique.begin(), clique.end(), [&](std::size_t other) { return cosine(other) > cosine(chosen); });
    const bool joins = settings.join_colinear && is_nearest && cosine(chosen) > 1 - settings.orthogonality_bound;
    if (i != chosen && !joins) continue;
    for (const std::size_t member : clusters[i].members) direction.points_in_map.push_back(planar.points[member]);
  }
  return direction;
}

std::string why_incomplete(const ClusterSubsetResult& result) {
  if (result.num_planar == 0) return fmt::format("none of {} points lies in a plane", result.num_points);
  if (result.num_clusters == 0) return "no direction has enough planar points";
  return fmt::format("only {} of 3 mutually orthogonal directions found in {} planar points",
                     result.subset.directions.size(), result.num_planar);
}

}  // namespace

void ClusterSubsetSettings::validate() const {
  require(num_scans >= 1, "num_scans", static_cast<double>(num_scans), "at least 1");
  require(planarity_ratio > 0, "planarity_ratio", planarity_ratio, "positive");
  require(linkage_cut > 0 && linkage_cut <= 1, "linkage_cut", linkage_cut, "in (0, 1]");
  require(orthogonality_bound > 0 && orthogonality_bound < 1.0 / 3, "orthogonality_bound", orthogonality_bound,
          "in (0, 1/3)");
  require(min_cluster_size >= 1, "min_cluster_size", static_cast<double>(min_cluster_size), "at least 1");
  if (num_nearest) require(*num_nearest >= 3, "num_nearest", static_cast<double>(*num_nearest), "at least 3");
}

ClusterSubsetSettings map_metrics_subset_settings() {
  return {.linkage = Linkage::kWard, .join_colinear = false, .num_nearest = 30};
}

ClusterSubsetResult cluster_subset(const RegisteredMap& map, double radius_m, const ClusterSubsetSettings& settings,
                                   const Execution& execution) {
  settings.validate();
  NeighborhoodSettings{.radius_m = radius_m}.validate();
  require_points_of_scans(map);
  ClusterSubsetResult result;
  PlanarPoints planar;  // step 1: planar points and their normals, scan by scan
  for (const std::uint32_t scan : evenly_spread_scans(map.num_scans, settings.num_scans)) {
    const PointsView points = points_of_scan(map, scan);
    const PlanarPoints found = planar_points_of(points, radius_m, settings, execution);
    result.num_points += points.size();
    planar.points.insert(planar.points.end(), found.points.begin(), found.points.end());
    planar.normals.insert(planar.normals.end(), found.normals.begin(), found.normals.end());
  }
  result.num_planar = planar.points.size();

  const std::vector<Cluster> clusters = large_clusters(planar, settings);  // step 2: clusters of normals
  result.num_clusters = clusters.size();

  std::vector<NormalCluster> summaries;  // step 3: the maximum clique of mutually orthogonal clusters
  for (const Cluster& cluster : clusters) summaries.push_back(cluster.summary);
  const std::vector<std::size_t> clique = largest_orthogonal_clique(summaries, settings.orthogonality_bound);
  for (const std::size_t chosen : clique) {
    result.subset.directions.push_back(direction_around(chosen, clique, clusters, planar, settings));
  }
  if (result.subset.directions.size() < 3) result.reason = why_incomplete(result);
  return result;
}

}  // namespace trysquare
