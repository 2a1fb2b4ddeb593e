// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/simulated_world.h"

#include "trysquare/core/error.h"
#include "trysquare/simulation/internal/polyline.h"
#include "trysquare/simulation/ray_caster.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace trysquare {
namespace {

constexpr std::array<WorldStyle, 6> kStyles = {WorldStyle::kStreet,  WorldStyle::kTownGrid, WorldStyle::kTownSuburb,
                                               WorldStyle::kTownOld, WorldStyle::kRoom,     WorldStyle::kOffice};

class Worlds : public testing::TestWithParam<WorldStyle> {};

bool is_same(const SimulatedWorld& a, const SimulatedWorld& b) {
  return a.mesh.vertices_in_world == b.mesh.vertices_in_world && a.mesh.triangles == b.mesh.triangles &&
         a.route_in_world == b.route_in_world;
}

TEST_P(Worlds, AreTheSameForTheSameSeedAndDifferForAnother) {
  EXPECT_TRUE(is_same(make_world(GetParam(), 1), make_world(GetParam(), 1)));
  EXPECT_FALSE(is_same(make_world(GetParam(), 1), make_world(GetParam(), 2)));
}

TEST_P(Worlds, HaveValidMeshesAndARouteThatKeepsClearOfThem) {
  for (const std::uint64_t seed : {0U, 1U, 2U}) {
    const SimulatedWorld world = make_world(GetParam(), seed);
    ASSERT_NO_THROW(world.mesh.validate());
    const RayCaster surfaces(world.mesh);
    const internal::Polyline route(world.route_in_world, world.route_is_loop);
    for (double s_m = 0; s_m < route.length_m(); s_m += route.length_m() / 60) {
      for (int k = 0; k < 24; ++k) {
        const double azimuth = 2 * std::acos(-1.0) * k / 24;
        const Ray level{route.at(s_m), {std::cos(azimuth), std::sin(azimuth), 0}};
        ASSERT_GT(surfaces.cast(level), 0.45) << "seed " << seed << " at " << s_m << " m, " << k;
      }
      const double to_ground_m = surfaces.cast({route.at(s_m), {0, 0, -1}});
      ASSERT_GT(to_ground_m, 1.0);
      ASSERT_LT(to_ground_m, 2.0);
    }
  }
}

/// Normal of the surface that a ray meets, from two more rays beside it; zero when one of them meets nothing.
Eigen::Vector3d normal_seen(const RayCaster& surfaces, const Ray& ray) {
  constexpr double kBeside = 1e-3;
  std::array<Eigen::Vector3d, 3> points;
  for (std::size_t k = 0; k < 3; ++k) {
    Eigen::Vector3d direction = ray.direction_in_world;
    if (k > 0)
      direction += kBeside * (k == 1 ? direction.unitOrthogonal() : direction.cross(direction.unitOrthogonal()));
    direction.normalize();
    const double range_m = surfaces.cast({ray.origin_in_world, direction}, 80);
    if (range_m == kNoReturn) return Eigen::Vector3d::Zero();
    points.at(k) = range_m * direction;
  }
  return (points[1] - points[0]).cross(points[2] - points[0]).normalized();
}

TEST_P(Worlds, ShowSurfacesInThreeDirectionsAlongTheRoute) {
  const SimulatedWorld world = make_world(GetParam(), 3);
  const RayCaster surfaces(world.mesh);
  const internal::Polyline route(world.route_in_world, world.route_is_loop);
  for (double s_m = 0; s_m < route.length_m(); s_m += route.length_m() / 20) {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 180; ++k) {
      const double azimuth = 2 * std::acos(-1.0) * k / 90;
      const double slope = k < 90 ? 0.0 : -0.6;
      const Eigen::Vector3d direction = Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), slope).normalized();
      const Eigen::Vector3d normal = normal_seen(surfaces, {route.at(s_m), direction});
      spread += normal * normal.transpose() / 180;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    EXPECT_GT(solver.eigenvalues()[0], 0.03) << s_m;  // the direction that is seen least has its share
    EXPECT_GT(spread.trace(), 0.7) << s_m;            // and most rays meet something
  }
}

INSTANTIATE_TEST_SUITE_P(Styles, Worlds, testing::ValuesIn(kStyles));

TEST(MakeWorld, StylesDiffer) {
  std::set<std::size_t> sizes;
  for (const WorldStyle style : kStyles) sizes.insert(make_world(style, 1).mesh.triangles.size());
  EXPECT_EQ(sizes.size(), kStyles.size());
}

/// Share of the area of upright walls whose normal is within a degree of the axes of the town.
double share_along_axes(WorldStyle style) {
  double along = 0;
  double all = 0;
  const TriangleMesh mesh = make_world(style, 1).mesh;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices_in_world[t[0]];
    const Eigen::Vector3d normal = (mesh.vertices_in_world[t[1]] - a).cross(mesh.vertices_in_world[t[2]] - a) / 2;
    const double area = normal.norm();
    if (area < 2 || std::abs(normal.z()) > 1e-6 * area) continue;
    all += area;
    if (normal.cwiseAbs().maxCoeff() > std::cos(0.0175) * area) along += area;
  }
  return along / all;
}

TEST(MakeWorld, TownsDifferInCharacter) {
  EXPECT_GT(share_along_axes(WorldStyle::kTownGrid), 0.9);
  EXPECT_LT(share_along_axes(WorldStyle::kTownSuburb), 0.4);
  EXPECT_LT(share_along_axes(WorldStyle::kTownOld), 0.4);
}

TEST(MakeWorld, FoliageIsClutterAndNoPlane) {
  // Normals of small triangles in the suburb, where leaves are, are spread evenly over the sphere.
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  const TriangleMesh mesh = make_world(WorldStyle::kTownSuburb, 1).mesh;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices_in_world[t[0]];
    const Eigen::Vector3d normal = (mesh.vertices_in_world[t[1]] - a).cross(mesh.vertices_in_world[t[2]] - a) / 2;
    if (normal.norm() < 0.1) spread += normal.normalized() * normal.normalized().transpose();
  }
  spread /= spread.trace();
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(spread(axis, axis), 1.0 / 3, 0.02);
}

TEST(MakeWorld, TownsAreLongEnoughForAThousandScansAndTurnBothWays) {
  for (const WorldStyle style : {WorldStyle::kTownGrid, WorldStyle::kTownSuburb, WorldStyle::kTownOld}) {
    const SimulatedWorld town = make_world(style, 1);
    ASSERT_TRUE(town.route_is_loop);
    const internal::Polyline route(town.route_in_world, true);
    EXPECT_GT(route.length_m(), 900);
    double left = 0;
    double right = 0;
    for (double s_m = 0; s_m < route.length_m(); s_m += 2) {
      const double turn = route.ahead(s_m, 1).cross(route.ahead(s_m + 2, 1)).z();
      (turn > 0 ? left : right) += std::abs(std::asin(turn));
    }
    EXPECT_GT(left, 8);   // six corners ...
    EXPECT_GT(right, 3);  // ... and two the other way
    EXPECT_NEAR(left - right, 2 * std::acos(-1.0), 0.2);
  }
}

TEST(MakeWorld, MovingCarsChangeNothingElse) {
  for (const WorldStyle style : {WorldStyle::kStreet, WorldStyle::kTownOld}) {
    const SimulatedWorld with_cars = make_world(style, 5, {.num_moving_cars = 7});
    EXPECT_EQ(with_cars.moving.size(), 7U);
    EXPECT_TRUE(is_same(with_cars, make_world(style, 5)));
  }
}

TEST(MakeWorld, StreetsAreAsLongAsAsked) {
  EXPECT_NEAR(make_world(WorldStyle::kStreet, 1, {.street_length_m = 123}).route_in_world.back().x(), 123, 1e-9);
}

TEST(MakeWorld, RefusesSettingsOutOfRange) {
  EXPECT_THROW(make_world(WorldStyle::kStreet, 1, {.street_length_m = 9}), InvalidArgument);
  EXPECT_THROW(make_world(WorldStyle::kStreet, 1, {.num_moving_cars = -1}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
