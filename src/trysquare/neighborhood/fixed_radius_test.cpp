// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/fixed_radius.h"

#include "trysquare/core/error.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

namespace trysquare {
namespace {

struct Map {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint32_t> scan_of_point;
};

Map random_map() {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> uniform(-2, 2);
  Map map;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    map.points.emplace_back(uniform(rng), uniform(rng), uniform(rng));
    map.scan_of_point.push_back(2 * (i % 3));  // scans 0, 2, 4 of 6
  }
  return map;
}

template <class Holds>
void expect_same(const std::vector<ScanMoments>& found, const Map& map, const Eigen::Vector3d& center,
                 const Holds& holds) {
  std::map<std::uint32_t, MomentsAccumulator> expected;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const Eigen::Vector3d d = map.points[i] - center;
    if (holds(d)) expected.try_emplace(map.scan_of_point[i], center).first->second.add(map.points[i]);
  }
  ASSERT_EQ(found.size(), expected.size());
  std::size_t i = 0;
  for (const auto& [scan, accumulator] : expected) {
    const Moments moments = accumulator.result();
    EXPECT_EQ(found[i].scan, scan);
    EXPECT_EQ(found[i].moments.count, moments.count);
    EXPECT_LT((found[i].moments.mean_from_query - moments.mean_from_query).norm(), 1e-13);
    EXPECT_LT((found[i].moments.covariance - moments.covariance).norm(), 1e-13);
    ++i;
  }
}

TEST(MomentsByScan, OfABallAreThoseOfBruteForce) {
  const Map map = random_map();
  const PointIndex index(map.points, map.scan_of_point, 6);
  const Ball ball{.center_in_map = {0.3, -0.2, 0.1}, .radius_m = 0.7};
  expect_same(moments_by_scan(index, ball), map, ball.center_in_map,
              [](const Eigen::Vector3d& d) { return d.norm() < 0.7; });
}

TEST(MomentsByScan, OfACylinderAreThoseOfBruteForce) {
  const Map map = random_map();
  const PointIndex index(map.points, map.scan_of_point, 6);
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -1).normalized();
  for (const double half_height_m : {0.1, 1.5}) {  // a disc and a pole
    const Cylinder cylinder{
        .center_in_map = {0.3, -0.2, 0.1}, .axis = axis, .radius_m = 0.6, .half_height_m = half_height_m};
    expect_same(moments_by_scan(index, cylinder), map, cylinder.center_in_map, [&](const Eigen::Vector3d& d) {
      return std::abs(d.dot(axis)) <= half_height_m && d.cross(axis).norm() < 0.6;
    });
  }
}

TEST(MomentsByScan, HoldTheCornersOfACylinder) {
  const std::vector<Eigen::Vector3d> points = {{0.999999, 0, 1}, {1, 0, 0}, {0, 0, 1.000001}, {0, 0, -1}};
  EXPECT_EQ(moments_by_scan(PointIndex(points), Cylinder{})[0].moments.count, 2u);
}

TEST(MomentsByScan, LeaveOutScansWithoutPoints) {
  const Map map = random_map();
  const PointIndex index(map.points, map.scan_of_point, 6);
  EXPECT_TRUE(moments_by_scan(index, Ball{.center_in_map = {50, 0, 0}}).empty());
  EXPECT_EQ(moments_by_scan(index, Ball{}).size(), 3u);
  EXPECT_EQ(moments_by_scan(PointIndex(map.points), Ball{}).size(), 1u);
}

TEST(MomentsByScanArguments, RefuseWhatIsOutOfRange) {
  const Map map = random_map();
  const PointIndex index(map.points);
  EXPECT_THROW(moments_by_scan(index, Ball{.radius_m = 0}), InvalidArgument);
  EXPECT_THROW(moments_by_scan(index, Ball{.center_in_map = {std::nan(""), 0, 0}}), InvalidArgument);
  EXPECT_THROW(moments_by_scan(index, Cylinder{.axis = {0, 0, 2}}), InvalidArgument);
  EXPECT_THROW(moments_by_scan(index, Cylinder{.half_height_m = -1}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
