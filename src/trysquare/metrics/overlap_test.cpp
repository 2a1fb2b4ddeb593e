// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/overlap.h"

#include "trysquare/metrics/metrics_test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trysquare {
namespace {

TEST(Overlap, CountsUsedNeighborhoodsOnly) {
  PointStatistics points;
  points.plane_variances = {1.0, std::nan(""), 0.0, 1.0, 1.0};
  points.entropies.resize(5);
  points.num_neighbors = {10, 2, 10, 10, 8};
  points.num_scans = {3, 2, 1, 4, 1};
  points.num_line_like = 1;
  const Overlap result = overlap(points);
  EXPECT_EQ(result.num_neighborhoods, 4u);
  EXPECT_DOUBLE_EQ(*result.scans_per_neighborhood_mean, 9.0 / 4);
  EXPECT_DOUBLE_EQ(*result.multi_scan_share, 0.5);
  EXPECT_DOUBLE_EQ(*result.neighbors_mean, 8.0);
  EXPECT_DOUBLE_EQ(*result.line_like_share, 0.25);
}

TEST(Overlap, OfNothingIsUndefined) {
  EXPECT_FALSE(overlap({}).multi_scan_share);
  EXPECT_FALSE(overlap({}).neighbors_mean);
}

// The isolation trap: scans that fly apart look clean to every metric; only the overlap sees it.
TEST(Overlap, FallsWhenTheScansFlyApart) {
  test::Scene scene = test::three_walls(0.02);
  const auto share = [&] {
    return *overlap(point_statistics(PointIndex(scene.map), scene.map.points_in_map, {.radius_m = 0.5}))
                .multi_scan_share;
  };
  EXPECT_GT(share(), 0.99);
  for (std::size_t i = 0; i < scene.map.points_in_map.size(); ++i) {
    scene.map.points_in_map[i] += 100.0 * scene.map.scan_of_point[i] * Eigen::Vector3d::Ones();
  }
  EXPECT_EQ(share(), 0.0);
}

}  // namespace
}  // namespace trysquare
