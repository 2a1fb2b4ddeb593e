// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/internal/complete_linkage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace trysquare::internal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Around the x axis, as far as `spread` says; both signs.
std::vector<Eigen::Vector3d> random_normals(std::size_t count, double spread, unsigned seed) {
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> normal(0, spread);
  std::vector<Eigen::Vector3d> normals;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d n = Eigen::Vector3d(normal(rng), 1 + normal(rng), normal(rng)).normalized();
    normals.push_back(i % 3 == 0 ? -n : n);
  }
  return normals;
}

double squared(const Eigen::Vector3d& d) { return (d.x() * d.x() + d.y() * d.y()) + d.z() * d.z(); }

double squared_distance_of(const Eigen::Vector3d& n, const Eigen::Vector3d& m, bool sign_free) {
  return sign_free ? std::min(squared(n - m), squared(n + m)) : squared(n - m);
}

/// Points 0 to 19 merged into cluster 0 and 20 to 49 into cluster 20, one after the other.
CompleteLinkage two_clusters(const std::vector<Eigen::Vector3d>& normals, bool sign_free) {
  CompleteLinkage linkage(normals, sign_free);
  for (std::uint32_t i = 1; i < 20; ++i) linkage.merge(0, i);
  for (std::uint32_t i = 21; i < 50; ++i) linkage.merge(20, i);
  return linkage;
}

double farthest_pair(const std::vector<Eigen::Vector3d>& normals, bool sign_free) {
  double greatest = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    for (std::size_t j = 20; j < 50; ++j) {
      greatest = std::max(greatest, squared_distance_of(normals[i], normals[j], sign_free));
    }
  }
  return greatest;
}

TEST(CompleteLinkage, IsTheDistanceOfTheFarthestMembersToTheLastBit) {
  for (const bool sign_free : {true, false}) {
    for (const double spread : {1e-3, 0.1, 10.0}) {
      for (unsigned seed = 0; seed < 50; ++seed) {
        const std::vector<Eigen::Vector3d> normals = random_normals(50, spread, seed);
        EXPECT_EQ(two_clusters(normals, sign_free).squared_distance(0, 20, kInfinity),
                  farthest_pair(normals, sign_free));
      }
    }
  }
}

// The distances of all pairs of members are where a search could stop one pair too early.
TEST(CompleteLinkage, StopsOnlyAboveWhereItMay) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const std::vector<Eigen::Vector3d> normals = random_normals(50, 0.1, seed);
    CompleteLinkage linkage = two_clusters(normals, true);
    const double exact = farthest_pair(normals, true);
    EXPECT_EQ(linkage.squared_distance(0, 20, exact), exact);
    for (std::size_t i = 0; i < 20; ++i) {
      for (std::size_t j = 20; j < 50; ++j) {
        const double stop = squared_distance_of(normals[i], normals[j], true);
        if (stop == exact) continue;
        EXPECT_GT(linkage.squared_distance(0, 20, stop), stop);
      }
    }
  }
}

TEST(CompleteLinkage, IsNeverNearerThanItsLowerBound) {
  for (const bool sign_free : {true, false}) {
    for (const double spread : {1e-3, 0.1, 10.0}) {
      for (unsigned seed = 0; seed < 50; ++seed) {
        const std::vector<Eigen::Vector3d> normals = random_normals(50, spread, seed);
        const CompleteLinkage linkage = two_clusters(normals, sign_free);
        for (std::size_t j = 20; j + 1 < 50; ++j) {
          const ClusterBox box = united(box_of(normals[j]), box_of(normals[j + 1]));
          double farthest = 0;
          for (std::size_t i = 0; i < 20; ++i) {
            farthest = std::max(farthest, squared_distance_of(normals[i], normals[j], sign_free));
          }
          EXPECT_LE(linkage.lower_bound(0, ClusterRegion{box, 1}), farthest);
        }
      }
    }
  }
}

}  // namespace
}  // namespace trysquare::internal
