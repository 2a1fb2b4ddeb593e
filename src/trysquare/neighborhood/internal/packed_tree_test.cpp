// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/internal/packed_tree.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace trysquare {
namespace {

using Tree = PointIndex::Tree;

std::vector<Eigen::Vector3d> random_points(std::size_t count, const Eigen::Vector3d& center_m) {
  std::mt19937 rng(3);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> points(count);
  for (Eigen::Vector3d& point : points) point = center_m + Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
  return points;
}

TEST(MomentRow, ShiftedIsTheSameAboutAnotherPoint) {
  const Eigen::Vector3d from(0.5, -2, 7);
  const Eigen::Vector3d to(1, 3, -4);
  MomentRow about_from;
  MomentRow about_to;
  for (const Eigen::Vector3d& point : random_points(50, {0, 0, 0})) {
    about_from.add_point(point.x() - from.x(), point.y() - from.y(), point.z() - from.z());
    about_to.add_point(point.x() - to.x(), point.y() - to.y(), point.z() - to.z());
  }
  const MomentRow shifted = about_from.shifted(from - to);
  for (std::size_t i = 0; i < MomentRow::kSize; ++i) EXPECT_NEAR(shifted.sums[i], about_to.sums[i], 1e-10) << i;
}

TEST(PackedTree, NodesHoldTheirPointsAndKnowTheirMoments) {
  for (const Eigen::Vector3d& center_m : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4e5, 5e6, 100)}) {
    const std::vector<Eigen::Vector3d> points = random_points(2345, center_m);
    const Tree tree(points, {}, 0, {});
    ASSERT_EQ(tree.top_level(), 3u);
    for (std::size_t level = 0; level <= tree.top_level(); ++level) {
      const Boxes& boxes = tree.boxes_of(level);
      for (std::size_t node = 0; node < boxes.size; ++node) {
        const Eigen::Vector3d about = tree.packed.origin + (level > 0 ? tree.levels[level - 1].center(node)
                                                                      : Eigen::Vector3d(Eigen::Vector3d::Zero()));
        MomentRow sums;
        for (std::size_t i = tree.first_point(level, node); i < tree.end_point(level, node); ++i) {
          const Eigen::Vector3d point = tree.packed.point(i);
          ASSERT_EQ(point, points[tree.packed.original_index[i]]);
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const double at = (point - tree.packed.origin)[static_cast<Eigen::Index>(axis)];
            ASSERT_LT(static_cast<double>(boxes.lo[axis][node]), at);
            ASSERT_GT(static_cast<double>(boxes.hi[axis][node]), at);
          }
          sums.add_point(point.x() - about.x(), point.y() - about.y(), point.z() - about.z());
        }
        if (level == 0) continue;
        for (std::size_t i = 0; i < MomentRow::kSize; ++i) {
          ASSERT_NEAR(tree.levels[level - 1].moments[node].sums[i], sums.sums[i], 1e-11 * sums.count());
        }
      }
    }
  }
}

TEST(PackedTree, IsTheSameForEveryNumberOfThreads) {
  const std::vector<Eigen::Vector3d> points = random_points(50'000, {0, 0, 0});
  const Tree one(points, {}, 0, {.num_threads = 1});
  const Tree two(points, {}, 0, {.num_threads = 2});
  EXPECT_EQ(one.packed.original_index, two.packed.original_index);
  EXPECT_EQ(one.packed.coordinates, two.packed.coordinates);
  for (std::size_t i = 0; i < one.levels.back().moments.size(); ++i) {
    for (std::size_t k = 0; k < MomentRow::kSize; ++k) {
      EXPECT_EQ(one.levels.back().moments[i].sums[k], two.levels.back().moments[i].sums[k]);
    }
  }
}

}  // namespace
}  // namespace trysquare
