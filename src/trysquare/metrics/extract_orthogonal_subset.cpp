// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/extract_orthogonal_subset.h"

#include "trysquare/core/error.h"
#include "trysquare/metrics/internal/thin_points.h"
#include "trysquare/metrics/normal_clusters.h"
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

/// Points of a map in scan order: those of scan i are [begin, end).
PointsView points_of_scan(const RegisteredMap& map, std::uint32_t scan) {
  const auto [begin, end] = std::equal_range(map.scan_of_point.begin(), map.scan_of_point.end(), scan);
  return PointsView(map.points_in_map)
      .subspan(static_cast<std::size_t>(begin - map.scan_of_point.begin()), static_cast<std::size_t>(end - begin));
}

std::vector<std::uint32_t> evenly_spread(std::size_t num_scans, std::size_t num_chosen) {
  num_chosen = std::min(num_chosen, num_scans);
  std::vector<std::uint32_t> chosen;
  for (std::size_t k = 0; k < num_chosen; ++k) {
    chosen.push_back(static_cast<std::uint32_t>(num_chosen == 1 ? 0 : k * (num_scans - 1) / (num_chosen - 1)));
  }
  return chosen;
}

struct Cluster {
  NormalCluster summary;
  std::vector<std::size_t> members;  ///< Indices of planar points.
};

/// Mean of normals that agree up to sign.
Eigen::Vector3d mean_normal(const std::vector<Eigen::Vector3d>& normals, const std::vector<std::size_t>& members) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& first = normals[members.front()];
  for (const std::size_t member : members) sum += normals[member].dot(first) < 0 ? -normals[member] : normals[member];
  return sum.normalized();
}

std::vector<Cluster> large_clusters(const PlanarPoints& planar, const OrthogonalSubsetSettings& settings) {
  const std::vector<std::uint32_t> labels = cluster_normals(planar.normals, {.cut = settings.linkage_cut});
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

/// The points of the clique's cluster and of every cluster co-linear with it; a cluster joins one direction at most,
/// since two orthogonal directions cannot both be co-linear with it.
OrthogonalSubset::Direction direction_around(std::size_t chosen, const std::vector<Cluster>& clusters,
                                             const PlanarPoints& planar, const OrthogonalSubsetSettings& settings) {
  OrthogonalSubset::Direction direction{.normal_in_map = clusters[chosen].summary.normal};
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const double cosine = std::abs(clusters[i].summary.normal.dot(direction.normal_in_map));
    const bool joins = settings.join_colinear && cosine > 1 - settings.orthogonality_bound;
    if (i != chosen && !joins) continue;
    for (const std::size_t member : clusters[i].members) direction.points_in_map.push_back(planar.points[member]);
  }
  return direction;
}

std::string why_incomplete(const OrthogonalSubsetResult& result) {
  if (result.num_planar == 0) return fmt::format("none of {} points lies in a plane", result.num_points);
  if (result.num_clusters == 0) return "no direction has enough planar points";
  return fmt::format("only {} of 3 mutually orthogonal directions found in {} planar points",
                     result.subset.directions.size(), result.num_planar);
}

}  // namespace

void OrthogonalSubsetSettings::validate() const {
  require(planarity_ratio > 0, "planarity_ratio", planarity_ratio, "positive");
  require(linkage_cut > 0 && linkage_cut <= 1, "linkage_cut", linkage_cut, "in (0, 1]");
  require(orthogonality_bound > 0 && orthogonality_bound < 1.0 / 3, "orthogonality_bound", orthogonality_bound,
          "in (0, 1/3)");
  require(min_cluster_size >= 1, "min_cluster_size", static_cast<double>(min_cluster_size), "at least 1");
  require(num_scans >= 1, "num_scans", static_cast<double>(num_scans), "at least 1");
  require(max_points >= 1, "max_points", static_cast<double>(max_points), "at least 1");
}

OrthogonalSubsetResult extract_orthogonal_subset(const RegisteredMap& map, double radius_m,
                                                 const OrthogonalSubsetSettings& settings, const Execution& execution) {
  settings.validate();
  const NeighborhoodSettings neighborhood{.radius_m = radius_m, .min_neighbors = kMinNeighborsOfNormal};
  neighborhood.validate();
  OrthogonalSubsetResult result;
  PlanarPoints planar;
  const std::vector<std::uint32_t> scans = evenly_spread(map.num_scans, settings.num_scans);
  for (const std::uint32_t scan : scans) {  // step 1: planar points and their normals, scan by scan
    const PointsView points = points_of_scan(map, scan);
    const std::vector<Eigen::Vector3d> queries =
        thin_points(points, radius_m / 8, std::max<std::size_t>(settings.max_points / scans.size(), 1));
    PlanarPoints found = planar_points(PointIndex(points), queries, neighborhood, settings.planarity_ratio, execution);
    result.num_points += queries.size();
    planar.points.insert(planar.points.end(), found.points.begin(), found.points.end());
    planar.normals.insert(planar.normals.end(), found.normals.begin(), found.normals.end());
  }
  result.num_planar = planar.points.size();

  const std::vector<Cluster> clusters = large_clusters(planar, settings);  // step 2: clusters of normals
  result.num_clusters = clusters.size();

  std::vector<NormalCluster> summaries;  // step 3: the maximum clique of mutually orthogonal clusters
  for (const Cluster& cluster : clusters) summaries.push_back(cluster.summary);
  for (const std::size_t chosen : largest_orthogonal_clique(summaries, settings.orthogonality_bound)) {
    result.subset.directions.push_back(direction_around(chosen, clusters, planar, settings));
  }
  if (result.subset.directions.size() < 3) result.reason = why_incomplete(result);
  return result;
}

}  // namespace trysquare
