// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/internal/hilbert_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace trysquare {
namespace {

std::vector<Eigen::Vector3d> full_grid(int side) {
  std::vector<Eigen::Vector3d> points;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) points.emplace_back(x, y, z);
    }
  }
  return points;
}

// What makes it a Hilbert curve: each step leads to the next cell. A Morton curve jumps.
TEST(HilbertOrder, GoesFromEachCellToOneBesideIt) {
  const std::vector<Eigen::Vector3d> points = full_grid(16);
  const HilbertCube cube{.lowest = {-0.5, -0.5, -0.5}, .edge_m = 16};
  const std::vector<std::uint32_t> order = hilbert_order(points, cube, {});
  for (std::size_t i = 1; i < order.size(); ++i) {
    ASSERT_DOUBLE_EQ((points[order[i]] - points[order[i - 1]]).norm(), 1.0) << "step " << i;
  }
}

TEST(HilbertOrder, NamesEveryPointOnce) {
  std::mt19937 rng(3);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 20'001; ++i) points.emplace_back(normal(rng), normal(rng), normal(rng));
  std::vector<std::uint32_t> order = hilbert_order(points, hilbert_cube_around(points), {.num_threads = 2});
  EXPECT_EQ(order, hilbert_order(points, hilbert_cube_around(points), {.num_threads = 1}));
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_EQ(order, all);
}

TEST(HilbertOrder, KeepsTheOrderWithinACell) {
  const std::vector<Eigen::Vector3d> points(100, Eigen::Vector3d(1, 2, 3));
  const std::vector<std::uint32_t> order = hilbert_order(points, hilbert_cube_around(points), {});
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(HilbertOrder, TakesPointsOutsideTheCubeForPointsOnItsBorder) {
  const std::vector<Eigen::Vector3d> points = {
      {0.9, 0.9, 0.9}, {-5, -5, -5}, {0.1, 0.1, 0.1}, {7, 7, 7}, {-1e300, 0, 0}};
  EXPECT_EQ(hilbert_order(points, {.lowest = Eigen::Vector3d::Zero(), .edge_m = 1}, {}).size(), points.size());
}

}  // namespace
}  // namespace trysquare
