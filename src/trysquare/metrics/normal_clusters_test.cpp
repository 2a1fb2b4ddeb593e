// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/normal_clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace trysquare {
namespace {

using Partition = std::set<std::set<std::size_t>>;

Partition partition_of(const std::vector<std::uint32_t>& labels) {
  std::map<std::uint32_t, std::set<std::size_t>> clusters;
  for (std::size_t i = 0; i < labels.size(); ++i) clusters[labels[i]].insert(i);
  Partition partition;
  for (const auto& [label, members] : clusters) partition.insert(members);
  return partition;
}

double distance(const Eigen::Vector3d& n, const Eigen::Vector3d& m) {
  return std::sqrt(2 - 2 * std::abs(n.dot(m)));  // another formula than the code's
}

/// The definition, word for word: again and again merge the two clusters whose farthest members are nearest.
Partition by_definition(const std::vector<Eigen::Vector3d>& normals, double cut) {
  std::vector<std::set<std::size_t>> clusters;
  for (std::size_t i = 0; i < normals.size(); ++i) clusters.push_back({i});
  while (true) {
    double least = cut;
    std::pair<std::size_t, std::size_t> best;
    for (std::size_t a = 0; a < clusters.size(); ++a) {
      for (std::size_t b = a + 1; b < clusters.size(); ++b) {
        double linkage = 0;
        for (const std::size_t i : clusters[a]) {
          for (const std::size_t j : clusters[b]) linkage = std::max(linkage, distance(normals[i], normals[j]));
        }
        if (linkage < least) {
          least = linkage;
          best = {a, b};
        }
      }
    }
    if (least == cut) return {clusters.begin(), clusters.end()};
    clusters[best.first].merge(clusters[best.second]);
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(best.second));
  }
}

std::vector<Eigen::Vector3d> random_normals(std::size_t count, double spread, unsigned seed) {
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> normal(0, spread);
  std::vector<Eigen::Vector3d> normals;
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d n = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(i % 3));
    n += Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
    normals.push_back((i % 2 == 0 ? 1 : -1) * n.normalized());
  }
  return normals;
}

TEST(ClusterNormals, MakesThePartitionOfTheDefinition) {
  for (const double spread : {0.02, 0.1, 1.0}) {
    for (unsigned seed = 0; seed < 8; ++seed) {
      const std::vector<Eigen::Vector3d> normals = random_normals(90, spread, seed);
      EXPECT_EQ(partition_of(cluster_normals(normals, 0.1)), by_definition(normals, 0.1)) << spread << " " << seed;
    }
  }
}

TEST(ClusterNormals, TakesOppositeNormalsForOne) {
  const std::vector<Eigen::Vector3d> normals = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}};
  EXPECT_EQ(cluster_normals(normals, 0.1), (std::vector<std::uint32_t>{0, 0, 1}));
}

// Single linkage would join the chain; complete linkage may not: its ends are 0.12 apart.
TEST(ClusterNormals, KeepsTheEndsOfAChainApart) {
  std::vector<Eigen::Vector3d> normals;
  for (const double angle : {0.0, 0.06, 0.12}) normals.emplace_back(std::cos(angle), std::sin(angle), 0);
  EXPECT_EQ(partition_of(cluster_normals(normals, 0.1)).size(), 2u);
}

TEST(ClusterNormals, EndsOnExactTies) {
  const std::vector<Eigen::Vector3d> normals(200, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(partition_of(cluster_normals(normals, 0.1)).size(), 1u);
  EXPECT_TRUE(cluster_normals({}, 0.1).empty());
}

}  // namespace
}  // namespace trysquare
