// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/stream_neighborhoods.h"

#include "trysquare/core/error.h"
#include "trysquare/neighborhood/eigenvalues.h"
#include "trysquare/neighborhood/neighborhood_test_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace trysquare {
namespace {

using Scans = std::vector<std::vector<Eigen::Vector3d>>;

/// Rings of points on the floor and a wall, as a spinning sensor writes them.
Scans ring_scans(std::size_t num_scans, const Eigen::Vector3d& center_m) {
  std::mt19937 rng(3);
  std::normal_distribution<double> noise(0, 0.01);
  Scans scans(num_scans);
  for (std::size_t scan = 0; scan < num_scans; ++scan) {
    for (int ring = 1; ring <= 12; ++ring) {
      for (int step = 0; step < 90; ++step) {
        const double angle = 0.07 * step;
        const Eigen::Vector3d point(0.4 * ring * std::cos(angle) + 0.1 * static_cast<double>(scan),
                                    std::min(0.4 * ring * std::sin(angle), 2.0), noise(rng));
        scans[scan].push_back(center_m + point);
      }
    }
  }
  return scans;
}

std::vector<Moments> streamed(const Scans& scans, PointsView queries, double radius_m, int num_threads = 1) {
  std::vector<Moments> result(queries.size());
  stream_neighborhoods(
      scans.size(), [&](std::size_t scan) { return scans[scan]; }, queries, {.radius_m = radius_m},
      {.num_threads = num_threads},
      [&](const NeighborhoodBlock& block) {
        for (std::size_t i = 0; i < block.queries.size(); ++i) result[block.queries[i]] = block.moments[i];
      });
  return result;
}

void expect_exact(const std::vector<Moments>& moments, const Scans& scans, PointsView queries, double radius_m) {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint32_t> scan_of_point;
  for (std::size_t scan = 0; scan < scans.size(); ++scan) {
    points.insert(points.end(), scans[scan].begin(), scans[scan].end());
    scan_of_point.resize(points.size(), static_cast<std::uint32_t>(scan));
  }
  std::vector<Eigen::Vector3d> lambdas(moments.size());
  eigenvalues(moments, lambdas);
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const auto exact = test::exact_neighborhood(points, scan_of_point, queries[q], radius_m);
    ASSERT_EQ(moments[q].count, exact.count) << "query " << q;
    ASSERT_EQ(moments[q].num_scans, exact.num_scans) << "query " << q;
    const auto largest = static_cast<double>(exact.eigenvalues[2]);
    for (int k = 0; k < 3; ++k) {
      ASSERT_LE(std::abs(lambdas[q][k] - static_cast<double>(exact.eigenvalues[k])), 1e-12 * largest) << "query " << q;
    }
  }
}

std::vector<Eigen::Vector3d> some_points(const Scans& scans, std::size_t every) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < scans[0].size(); i += every) points.push_back(scans[0][i]);
  return points;
}

TEST(StreamNeighborhoods, FindsWhatBruteForceFinds) {
  const Scans scans = ring_scans(20, {0, 0, 0});  // more than are under way at once
  for (const double radius_m : {0.2, 1.0}) {
    const std::vector<Eigen::Vector3d> queries = some_points(scans, 7);
    expect_exact(streamed(scans, queries, radius_m), scans, queries, radius_m);
  }
}

TEST(StreamNeighborhoods, IsExactInUtmCoordinates) {
  const Scans scans = ring_scans(3, {431'234.567, 5'412'345.678, 213.4});
  const std::vector<Eigen::Vector3d> queries = some_points(scans, 7);
  expect_exact(streamed(scans, queries, 0.5), scans, queries, 0.5);
}

TEST(StreamNeighborhoods, TakesPointsInAnyOrder) {
  Scans scans = ring_scans(2, {0, 0, 0});
  const std::vector<Eigen::Vector3d> queries = some_points(scans, 7);
  std::mt19937 rng(5);
  for (std::vector<Eigen::Vector3d>& scan : scans) std::shuffle(scan.begin(), scan.end(), rng);
  expect_exact(streamed(scans, queries, 0.1), scans, queries, 0.1);
}

// These are looked at again, in a second run over the scans.
TEST(StreamNeighborhoods, KeepsTheDigitsOfSmallClusters) {
  std::mt19937 rng(7);
  std::normal_distribution<double> tiny(0, 1e-5);
  Scans scans(18);
  for (std::vector<Eigen::Vector3d>& scan : scans) {
    for (int i = 0; i < 200; ++i) scan.emplace_back(1.1 * (i / 10) + tiny(rng), tiny(rng), tiny(rng) / 100);
  }
  const std::vector<Eigen::Vector3d> queries = some_points(scans, 3);
  expect_exact(streamed(scans, queries, 1.0), scans, queries, 1.0);
}

TEST(StreamNeighborhoods, TakesRadiiThatSinglePrecisionCannotHold) {
  const Scans scans = ring_scans(2, {0, 0, 0});
  const std::vector<Eigen::Vector3d> queries = some_points(scans, 100);
  for (const double radius_m : {1e-20, 1e20}) {
    expect_exact(streamed(scans, queries, radius_m), scans, queries, radius_m);
  }
}

TEST(StreamNeighborhoods, IsBitIdenticalForEveryNumberOfThreads) {
  const Scans scans = ring_scans(20, {0, 0, 0});
  const std::vector<Eigen::Vector3d> queries = some_points(scans, 3);
  const std::vector<Moments> one = streamed(scans, queries, 0.7, 1);
  for (const int num_threads : {0, 2, 3}) {
    const std::vector<Moments> other = streamed(scans, queries, 0.7, num_threads);
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one[i].covariance, other[i].covariance);
  }
}

TEST(StreamNeighborhoods, OfNothingAreEmpty) {
  const std::vector<Eigen::Vector3d> queries = {{0, 0, 0}};
  EXPECT_EQ(streamed({}, queries, 1.0)[0].count, 0u);
  EXPECT_EQ(streamed({{}, {}}, queries, 1.0)[0].count, 0u);
  EXPECT_TRUE(streamed(ring_scans(1, {0, 0, 0}), {}, 1.0).empty());
}

TEST(StreamNeighborhoodsArguments, RefuseWhatIsOutOfRange) {
  const std::vector<Eigen::Vector3d> queries = {{0, 0, 0}};
  const std::vector<Eigen::Vector3d> no_point = {{0, std::nan(""), 0}};
  EXPECT_THROW(streamed({queries}, queries, -1.0), InvalidArgument);
  EXPECT_THROW(streamed({no_point}, queries, 1.0), InvalidArgument);
  EXPECT_THROW(streamed({queries}, no_point, 1.0), InvalidArgument);
}

TEST(StreamNeighborhoods, PassesOnWhatAScanThrows) {
  const std::vector<Eigen::Vector3d> queries = {{0, 0, 0}};
  const auto broken = [](std::size_t) -> std::vector<Eigen::Vector3d> { throw IoError("torn"); };
  EXPECT_THROW(stream_neighborhoods(3, broken, queries, {}, {}, [](const NeighborhoodBlock&) {}), IoError);
}

}  // namespace
}  // namespace trysquare
