// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/for_each_neighborhood.h"

#include "trysquare/core/error.h"
#include "trysquare/neighborhood/eigenvalues.h"
#include "trysquare/neighborhood/internal/visit_neighborhoods.h"
#include "trysquare/neighborhood/neighborhood_test_oracle.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace trysquare {
namespace {

struct Cloud {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint32_t> scan_of_point;
  std::size_t num_scans = 0;
};

// Coordinates on a 1/8 grid: many pairs of points are exactly one radius apart.
Cloud grid_cloud(std::size_t num_points) {
  std::mt19937 rng(3);
  std::uniform_int_distribution<int> eighths(-16, 16);
  std::uniform_int_distribution<std::uint32_t> scan(0, 6);
  Cloud cloud{.num_scans = 7};
  for (std::size_t i = 0; i < num_points; ++i) {
    cloud.points.emplace_back(eighths(rng) / 8.0, eighths(rng) / 8.0, eighths(rng) / 8.0);
    cloud.scan_of_point.push_back(scan(rng));
  }
  return cloud;
}

using Visit = std::function<void(const NeighborhoodBlock&)>;

std::vector<Moments> collect(std::size_t num_queries, const std::function<void(const Visit&)>& run) {
  std::vector<Moments> result(num_queries);
  std::vector<int> num_visits(num_queries, 0);
  run([&](const NeighborhoodBlock& block) {
    for (std::size_t i = 0; i < block.queries.size(); ++i) {
      result[block.queries[i]] = block.moments[i];
      ++num_visits[block.queries[i]];
    }
  });
  EXPECT_EQ(std::count(num_visits.begin(), num_visits.end(), 1), static_cast<std::ptrdiff_t>(num_queries));
  return result;
}

std::vector<Moments> all_moments(const PointIndex& index, PointsView queries, double radius_m, int num_threads = 1) {
  return collect(queries.size(), [&](const Visit& visit) {
    for_each_neighborhood(index, queries, {.radius_m = radius_m}, {.num_threads = num_threads}, visit);
  });
}

std::vector<Moments> moments_by(const VectorKernels* kernels, const Cloud& cloud, PointsView queries, double radius_m) {
  const PointIndex index(cloud.points, cloud.scan_of_point, cloud.num_scans);
  return collect(queries.size(), [&](const Visit& visit) {
    visit_neighborhoods(kernels, index, queries, {.radius_m = radius_m}, {.num_threads = 1}, visit);
  });
}

void expect_exact(const std::vector<Moments>& moments, const Cloud& cloud, PointsView queries, double radius_m) {
  std::vector<Eigen::Vector3d> lambdas(moments.size());
  eigenvalues(moments, lambdas);
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const auto exact = test::exact_neighborhood(cloud.points, cloud.scan_of_point, queries[q], radius_m);
    ASSERT_EQ(moments[q].count, exact.count) << "query " << q;
    ASSERT_EQ(moments[q].num_scans, exact.num_scans) << "query " << q;
    ASSERT_LE((moments[q].mean_from_query - exact.mean_from_query.cast<double>()).norm(), 1e-14 * radius_m);
    const auto largest = static_cast<double>(exact.eigenvalues[2]);
    for (int k = 0; k < 3; ++k) {
      ASSERT_LE(std::abs(lambdas[q][k] - static_cast<double>(exact.eigenvalues[k])), 1e-12 * largest)
          << "query " << q << " of " << queries.size() << " with " << exact.count << " neighbors, eigenvalue " << k;
    }
  }
}

/// Points on two noisy walls in the order of a scanner's rings, dense near the middle and thin far away.
Cloud walls(std::size_t num_points, std::size_t num_scans, const Eigen::Vector3d& center_m, unsigned seed = 7) {
  std::mt19937 rng(seed);
  std::normal_distribution<double> along(0, 3);
  std::normal_distribution<double> noise(0, 0.01);
  Cloud cloud{.num_scans = num_scans};
  for (std::size_t i = 0; i < num_points; ++i) {
    const double u = along(rng);
    const Eigen::Vector3d point = i % 3 == 0 ? Eigen::Vector3d(u, noise(rng), along(rng) / 3)
                                             : Eigen::Vector3d(noise(rng) + 1, u, along(rng) / 3);
    // Millimetres, as sensors write them: many distances are exact ties.
    cloud.points.push_back(center_m + (point * 1000).array().round().matrix() / 1000);
    cloud.scan_of_point.push_back(static_cast<std::uint32_t>(rng() % num_scans));
  }
  return cloud;
}

/// By the name of an instruction set, or the plain way.
class NeighborhoodsByKernel : public testing::TestWithParam<std::string> {
 protected:
  const VectorKernels* kernels() const { return GetParam() == "Plain" ? nullptr : &test::kernels_named(GetParam()); }
};

TEST_P(NeighborhoodsByKernel, AreThoseOfBruteForce) {
  const Cloud cloud = walls(3000, 20, {0, 0, 0});
  for (const double radius_m : {0.05, 0.3, 1.0}) {
    expect_exact(moments_by(kernels(), cloud, cloud.points, radius_m), cloud, cloud.points, radius_m);
  }
}

TEST_P(NeighborhoodsByKernel, AreExactWhereManyDistancesAreTies) {
  const Cloud cloud = grid_cloud(2500);
  for (const double radius_m : {0.125, 0.5, 0.625}) {  // 0.625² = 0.375² + 0.5²
    expect_exact(moments_by(kernels(), cloud, cloud.points, radius_m), cloud, cloud.points, radius_m);
  }
}

TEST_P(NeighborhoodsByKernel, AreExactInUtmCoordinates) {
  const Cloud cloud = walls(2000, 20, {431'234.567, 5'412'345.678, 213.4});
  expect_exact(moments_by(kernels(), cloud, cloud.points, 0.5), cloud, cloud.points, 0.5);
}

TEST_P(NeighborhoodsByKernel, CountMoreScansThanAWordHasBits) {
  const Cloud cloud = walls(3000, 500, {0, 0, 0});
  expect_exact(moments_by(kernels(), cloud, cloud.points, 1.0), cloud, cloud.points, 1.0);
}

// Nodes of 1024 points and more lie inside every ball: their sums and their scans count whole.
TEST_P(NeighborhoodsByKernel, OfBallsThatHoldLargeNodes) {
  const Cloud cloud = walls(6000, 200, {0, 0, 0});
  std::vector<Eigen::Vector3d> queries;
  for (std::size_t i = 0; i < cloud.points.size(); i += 50) queries.push_back(cloud.points[i]);
  for (const double radius_m : {2.0, 100.0}) {
    expect_exact(moments_by(kernels(), cloud, queries, radius_m), cloud, queries, radius_m);
  }
}

TEST_P(NeighborhoodsByKernel, OfQueriesThatAreNoPointsOfTheMap) {
  const Cloud cloud = walls(2000, 5, {0, 0, 0});
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> anywhere(-12, 12);  // some of them where there is nothing
  std::vector<Eigen::Vector3d> queries;
  for (int i = 0; i < 333; ++i) queries.emplace_back(anywhere(rng), anywhere(rng), anywhere(rng) / 4);
  for (const double radius_m : {0.4, 5.0}) {
    expect_exact(moments_by(kernels(), cloud, queries, radius_m), cloud, queries, radius_m);
  }
}

// One pass about a center 1 m away would lose six digits of these: they are looked at again.
TEST_P(NeighborhoodsByKernel, OfSmallClustersFarFromEachOtherKeepTheirDigits) {
  std::mt19937 rng(13);
  std::normal_distribution<double> tiny(0, 1e-5);
  Cloud cloud{.num_scans = 3};
  for (std::size_t i = 0; i < 2000; ++i) {
    const double at = static_cast<double>(i % 40) * 1.1;
    cloud.points.emplace_back(at + tiny(rng), tiny(rng), tiny(rng) / 100);
    cloud.scan_of_point.push_back(static_cast<std::uint32_t>(i % 3));
  }
  expect_exact(moments_by(kernels(), cloud, cloud.points, 1.0), cloud, cloud.points, 1.0);
}

TEST_P(NeighborhoodsByKernel, OfDegenerateGeometry) {
  std::mt19937 rng(17);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto made_by = [&](std::size_t num_points, const auto& make) {
    Cloud cloud{.num_scans = 2};
    for (std::size_t i = 0; i < num_points; ++i) {
      cloud.points.push_back(make());
      cloud.scan_of_point.push_back(static_cast<std::uint32_t>(i % 2));
    }
    return cloud;
  };
  const std::vector<Cloud> clouds = {
      made_by(1, [] { return Eigen::Vector3d(3, 4, 5); }),
      made_by(700, [] { return Eigen::Vector3d(0.1, -7.3, 2.2); }),                                   // all equal
      made_by(700, [&]() -> Eigen::Vector3d { return uniform(rng) * Eigen::Vector3d(1, 2, 3); }),     // a line
      made_by(700, [&] { return Eigen::Vector3d(uniform(rng), uniform(rng), 0.25); }),                // a plane
      made_by(700, [&] { return Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng) * 1e9); }),  // far apart
  };
  for (const Cloud& cloud : clouds) {
    for (const double radius_m : {1e-20, 1e-6, 0.3, 100.0, 1e20}) {  // below any spacing … larger than the map
      expect_exact(moments_by(kernels(), cloud, cloud.points, radius_m), cloud, cloud.points, radius_m);
    }
  }
}

// Clouds of any size, shape and scale, far from the origin or not, and whatever radius.
TEST_P(NeighborhoodsByKernel, AreThoseOfBruteForceForAnyCloud) {
  const bool holds = rc::check([&] {
    const auto seed = *rc::gen::arbitrary<unsigned>();
    const auto num_points = static_cast<std::size_t>(*rc::gen::inRange(1, 600));
    const auto num_scans = static_cast<std::size_t>(*rc::gen::inRange(1, 200));
    const double offset_m = *rc::gen::element(0.0, 1.0, 1e3, 5e6);
    const double radius_m = *rc::gen::element(0.01, 0.1, 0.5, 2.0, 30.0);
    const Cloud cloud = walls(num_points, num_scans, {offset_m, -offset_m, offset_m / 3}, seed);
    expect_exact(moments_by(kernels(), cloud, cloud.points, radius_m), cloud, cloud.points, radius_m);
    RC_ASSERT(!testing::Test::HasFatalFailure());
  });
  EXPECT_TRUE(holds);
}

INSTANTIATE_TEST_SUITE_P(Plain, NeighborhoodsByKernel, testing::Values("Plain"));
INSTANTIATE_TEST_SUITE_P(Vector, NeighborhoodsByKernel, testing::ValuesIn(test::names_of_kernels()));

TEST(VectorKernels, IncludeThoseOfTheMachinesThatPeopleHave) {
  const std::vector<std::string> names = test::names_of_kernels();
  EXPECT_FALSE(names.empty());
#if defined(__x86_64__)
  const auto has = [&](const char* name) { return std::count(names.begin(), names.end(), name) == 1; };
  EXPECT_EQ(has("AVX2"), __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"));
  EXPECT_EQ(has("SSE4"), __builtin_cpu_supports("sse4.2") != 0);
#endif
}

TEST(ForEachNeighborhood, VisitsEveryQueryOfAMapOnce) {
  const Cloud cloud = walls(4000, 20, {0, 0, 0});
  const PointIndex index(cloud.points, cloud.scan_of_point, cloud.num_scans);
  expect_exact(all_moments(index, cloud.points, 0.4), cloud, cloud.points, 0.4);
}

TEST(ForEachNeighborhood, LeavesOutPointsExactlyOneRadiusAway) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0.999, 0, 0}};
  EXPECT_EQ(all_moments(PointIndex(points), std::vector<Eigen::Vector3d>{{0, 0, 0}}, 1.0)[0].count, 2u);
}

TEST(ForEachNeighborhood, IsBitIdenticalForEveryNumberOfThreads) {
  const Cloud cloud = walls(20'000, 7, {0, 0, 0});
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

TEST(PointIndexArguments, RefusePointsWhoseSquaresOverflow) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {0, -1e151, 0}};
  EXPECT_THROW(PointIndex{PointsView(points)}, InvalidArgument);
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
