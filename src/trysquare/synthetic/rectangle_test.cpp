// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/rectangle.h"

#include <gtest/gtest.h>

#include <vector>

namespace trysquare {
namespace {

/// 2 m × 1 m at x = 5, y in [−1, 1], z in [0, 1].
const Rectangle kWall{{5, -1, 0}, {0, 2, 0}, {0, 0, 1}};
const Eigen::Vector3d kAhead(1, 0, 0);

TEST(DistanceAlongRay, IsThatToThePointWhereTheRayMeetsThePlane) {
  EXPECT_DOUBLE_EQ(*distance_along_ray(kWall, {0, 0, 0.5}, kAhead), 5);
  EXPECT_DOUBLE_EQ(*distance_along_ray(kWall, {1, -3, 0.5}, Eigen::Vector3d(4, 3, 0) / 5), 5);
}

TEST(DistanceAlongRay, IsUndefinedBesideTheRectangle) {
  EXPECT_FALSE(distance_along_ray(kWall, {0, 1.01, 0.5}, kAhead));
  EXPECT_FALSE(distance_along_ray(kWall, {0, -1.01, 0.5}, kAhead));
  EXPECT_FALSE(distance_along_ray(kWall, {0, 0, 1.01}, kAhead));
  EXPECT_FALSE(distance_along_ray(kWall, {0, 0, -0.01}, kAhead));
  EXPECT_TRUE(distance_along_ray(kWall, {0, 0.99, 0.99}, kAhead));
  EXPECT_TRUE(distance_along_ray(kWall, {0, -0.99, 0.01}, kAhead));
}

TEST(DistanceAlongRay, IsUndefinedBehindTheOriginOnThePlaneAndAlongIt) {
  EXPECT_FALSE(distance_along_ray(kWall, {0, 0, 0.5}, -kAhead));
  EXPECT_FALSE(distance_along_ray(kWall, {5, 0, 0.5}, kAhead));
  EXPECT_FALSE(distance_along_ray(kWall, {0, 0, 0.5}, {0, 1, 0}));
}

TEST(DistanceAlongRay, BothFacesReflect) { EXPECT_DOUBLE_EQ(*distance_along_ray(kWall, {9, 0, 0.5}, -kAhead), 4); }

TEST(CastRay, TheNearestSurfaceWinsInEveryOrder) {
  const Rectangle near{{3, -1, 0}, {0, 2, 0}, {0, 0, 1}};
  for (const std::vector<Rectangle>& scene : {std::vector{kWall, near}, std::vector{near, kWall}}) {
    const auto hit = cast_ray(scene, {0, 0, 0.5}, kAhead);
    ASSERT_TRUE(hit);
    EXPECT_DOUBLE_EQ(hit->distance_m, 3);
    EXPECT_EQ(scene[hit->rectangle_index].corner, near.corner);
  }
}

TEST(CastRay, EndsInTheSkyWhenNothingIsInTheWay) { EXPECT_FALSE(cast_ray(std::vector{kWall}, {0, 0, 0.5}, {0, 0, 1})); }

TEST(Box, IsClosedOnAllSixSides) {
  const std::vector<Rectangle> faces = box({1, 2, 3}, {2, 4, 6});
  ASSERT_EQ(faces.size(), 6u);
  const Eigen::Vector3d center(2, 4, 6);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const auto hit = cast_ray(faces, center, sign * Eigen::Vector3d::Unit(axis));
      ASSERT_TRUE(hit);
      EXPECT_DOUBLE_EQ(hit->distance_m, axis + 1);
    }
  }
}

TEST(Rectangle, NormalIsAUnitVectorAcrossBothSides) { EXPECT_EQ(kWall.normal(), Eigen::Vector3d(1, 0, 0)); }

}  // namespace
}  // namespace trysquare
