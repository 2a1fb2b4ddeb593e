// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/for_each_neighborhood.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <random>
#include <set>
#include <vector>

namespace trysquare {
namespace {

struct Cloud {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint32_t> scan_of_point;
};

// Coordinates on a 1/8 grid: many pairs of points are exactly one radius apart.
Cloud grid_cloud(std::size_t num_points) {
  std::mt19937 rng(3);
  std::uniform_int_distribution<int> eighths(-16, 16);
  std::uniform_int_distribution<std::uint32_t> scan(0, 6);
  Cloud cloud;
  for (std::size_t i = 0; i < num_points; ++i) {
    cloud.points.emplace_back(eighths(rng) / 8.0, eighths(rng) / 8.0, eighths(rng) / 8.0);
    cloud.scan_of_point.push_back(scan(rng));
  }
  return cloud;
}

std::vector<Moments> all_moments(const PointIndex& index, PointsView queries, double radius_m, int num_threads = 1) {
  std::vector<Moments> result(queries.size());
  for_each_neighborhood(index, queries, {.radius_m = radius_m}, {.num_threads = num_threads},
                        [&](const NeighborhoodBlock& block) {
                          std::copy(block.moments.begin(), block.moments.end(),
                                    result.begin() + static_cast<std::ptrdiff_t>(block.first_query));
                        });
  return result;
}

TEST(ForEachNeighborhood, FindsWhatBruteForceFinds) {
  const Cloud cloud = grid_cloud(1500);
  const PointIndex index(cloud.points, cloud.scan_of_point, 7);
  const std::vector<Moments> moments = all_moments(index, cloud.points, 0.5);
  for (std::size_t q = 0; q < cloud.points.size(); ++q) {
    MomentsAccumulator expected(cloud.points[q]);
    std::set<std::uint32_t> scans;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      if ((cloud.points[i] - cloud.points[q]).squaredNorm() < 0.25) {
        expected.add(cloud.points[i]);
        scans.insert(cloud.scan_of_point[i]);
      }
    }
    ASSERT_EQ(moments[q].count, expected.result().count) << "query " << q;
    ASSERT_EQ(moments[q].num_scans, scans.size());
    ASSERT_LT((moments[q].covariance - expected.result().covariance).norm(), 1e-14);
    ASSERT_LT((moments[q].mean_from_query - expected.result().mean_from_query).norm(), 1e-14);
  }
}

TEST(ForEachNeighborhood, LeavesOutPointsExactlyOneRadiusAway) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0.999, 0, 0}};
  EXPECT_EQ(all_moments(PointIndex(points), std::vector<Eigen::Vector3d>{{0, 0, 0}}, 1.0)[0].count, 2u);
}

TEST(ForEachNeighborhood, IsBitIdenticalForEveryNumberOfThreads) {
  const Cloud cloud = grid_cloud(5000);
  const PointIndex index(cloud.points, cloud.scan_of_point, 7);
  const std::vector<Moments> one = all_moments(index, cloud.points, 0.7, 1);
  for (const int num_threads : {0, 2, 3}) {
    const std::vector<Moments> other = all_moments(index, cloud.points, 0.7, num_threads);
    for (std::size_t i = 0; i < one.size(); ++i) {
      ASSERT_EQ(one[i].covariance, other[i].covariance);
      ASSERT_EQ(one[i].mean_from_query, other[i].mean_from_query);
    }
  }
}

TEST(ForEachNeighborhood, CountsNoScansWhereTheMapHasNone) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {0.1, 0, 0}};
  const Moments moments = all_moments(PointIndex(points), points, 1.0)[0];
  EXPECT_EQ(moments.count, 2u);
  EXPECT_EQ(moments.num_scans, 0u);
}

TEST(ForEachNeighborhood, FindsNothingInAnEmptyMap) {
  const std::vector<Eigen::Vector3d> queries = {{1, 2, 3}};
  EXPECT_EQ(all_moments(PointIndex(PointsView{}), queries, 1.0)[0].count, 0u);
}

TEST(ForEachNeighborhoodArguments, RefuseRadiiThatAreNotPositive) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}};
  const PointIndex index(points);
  for (const double radius_m : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(all_moments(index, points, radius_m), InvalidArgument) << radius_m;
  }
}

TEST(ForEachNeighborhoodArguments, RefuseQueriesThatAreNotFinite) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}};
  const std::vector<Eigen::Vector3d> queries = {{0, 0, std::nan("")}};
  EXPECT_THROW(all_moments(PointIndex(points), queries, 1.0), InvalidArgument);
}

TEST(PointIndexArguments, RefusePointsThatAreNotFinite) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {std::nan(""), 0, 0}};
  EXPECT_THROW(PointIndex{PointsView(points)}, InvalidArgument);
}

TEST(PointIndexArguments, RefuseScansThatDoNotExist) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}};
  const std::vector<std::uint32_t> scan_of_point = {1};
  EXPECT_THROW(PointIndex(points, scan_of_point, 1), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
