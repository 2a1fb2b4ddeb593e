// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/orthogonal_clique.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

namespace trysquare {
namespace {

using Indices = std::vector<std::size_t>;

TEST(LargestOrthogonalClique, TakesTheTriadWithTheMostPoints) {
  const double c = std::cos(0.5);
  const double s = std::sin(0.5);
  const std::vector<NormalCluster> clusters = {
      {{1, 0, 0}, 10}, {{0, 1, 0}, 10}, {{0, 0, 1}, 50}, {{c, s, 0}, 12}, {{-s, c, 0}, 11}};
  EXPECT_EQ(largest_orthogonal_clique(clusters, 0.1), (Indices{2, 3, 4}));
}

TEST(LargestOrthogonalClique, PrefersATriadToALargerPair) {
  const std::vector<NormalCluster> clusters = {
      {{1, 0, 0}, 10}, {{0, 1, 0}, 10}, {{0, 0, 1}, 10}, {{0.6, 0.8, 0}, 1000}};
  EXPECT_EQ(largest_orthogonal_clique(clusters, 0.1).size(), 3u);
}

TEST(LargestOrthogonalClique, TakesWhatThereIs) {
  EXPECT_EQ(largest_orthogonal_clique(std::vector<NormalCluster>{}, 0.1), Indices{});
  EXPECT_EQ(largest_orthogonal_clique(std::vector<NormalCluster>{{{1, 0, 0}, 5}, {{0.8, 0.6, 0}, 9}}, 0.1), Indices{1});
  EXPECT_EQ(largest_orthogonal_clique(std::vector<NormalCluster>{{{1, 0, 0}, 5}, {{0, -1, 0}, 9}}, 0.1),
            (Indices{1, 0}));
}

TEST(LargestOrthogonalClique, IgnoresTheSignsOfNormals) {
  std::vector<NormalCluster> clusters = {{{1, 0, 0}, 3}, {{0, 1, 0}, 2}, {{0, 0, 1}, 1}};
  clusters[1].normal *= -1;
  EXPECT_EQ(largest_orthogonal_clique(clusters, 0.1), (Indices{0, 1, 2}));
}

TEST(LargestOrthogonalClique, FindsWhatTryingEveryTriadFinds) {
  std::mt19937_64 rng(2);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<std::size_t> size(6, 500);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<NormalCluster> clusters(40);
    for (NormalCluster& cluster : clusters) {
      cluster = {Eigen::Vector3d(normal(rng), normal(rng), normal(rng)).normalized(), size(rng)};
    }
    std::size_t most = 0;
    const auto orthogonal = [&](std::size_t i, std::size_t j) {
      return std::abs(clusters[i].normal.dot(clusters[j].normal)) < 0.3;
    };
    for (std::size_t i = 0; i < 40; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k) {
          if (!orthogonal(i, j) || !orthogonal(j, k) || !orthogonal(i, k)) continue;
          most = std::max(most, clusters[i].num_points + clusters[j].num_points + clusters[k].num_points);
        }
      }
    }
    const Indices found = largest_orthogonal_clique(clusters, 0.3);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(clusters[found[0]].num_points + clusters[found[1]].num_points + clusters[found[2]].num_points, most);
  }
}

TEST(LargestOrthogonalClique, DoesNotDependOnTheOrderOfEqualClusters) {
  std::vector<NormalCluster> clusters = {
      {{1, 0, 0}, 5}, {{0, 1, 0}, 5}, {{0, 0, 1}, 5}, {{0.6, 0.8, 0}, 5}, {{-0.8, 0.6, 0}, 5}};
  const auto normals_of_best = [&] {
    std::set<double> xs;
    for (const std::size_t i : largest_orthogonal_clique(clusters, 0.1)) xs.insert(clusters[i].normal.x());
    return xs;
  };
  const std::set<double> before = normals_of_best();
  std::reverse(clusters.begin(), clusters.end());
  EXPECT_EQ(normals_of_best(), before);
}

}  // namespace
}  // namespace trysquare
