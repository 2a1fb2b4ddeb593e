// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/ray_caster.h"

#include "trysquare/core/error.h"
#include "trysquare/simulation/internal/mesh_builder.h"
#include "trysquare/synthetic/random.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace trysquare {
namespace {

using internal::MeshBuilder;

/// Two triangles that stand across x.
TriangleMesh wall(double x, double half_m, const Eigen::Vector3d& offset = Eigen::Vector3d::Zero()) {
  MeshBuilder mesh;
  const auto corner = [&](double y, double z) { return Eigen::Vector3d(offset + Eigen::Vector3d(x, y, z)); };
  mesh.add_quad(corner(-half_m, -half_m), corner(half_m, -half_m), corner(half_m, half_m), corner(-half_m, half_m));
  return mesh.take();
}

/// All of a box, open nowhere.
TriangleMesh box_of(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  MeshBuilder mesh;
  const Eigen::Vector2d center = (low + high).head<2>() / 2;
  mesh.add_block(internal::rectangle(center, high.x() - low.x(), high.y() - low.y(), 0), low.z(), high.z());
  mesh.add_quad(low, {high.x(), low.y(), low.z()}, {high.x(), high.y(), low.z()}, {low.x(), high.y(), low.z()});
  return mesh.take();
}

/// The half of a sphere that looks against x, fine enough that flat triangles lie less than r · step² / 4 inside it.
TriangleMesh cap_of_sphere(const Eigen::Vector3d& center, double radius_m, double step_rad) {
  const int num_rings = static_cast<int>(std::ceil(std::numbers::pi / 3 / step_rad));
  const int num_sectors = static_cast<int>(std::ceil(2 * std::numbers::pi / step_rad));
  const auto at = [&](int ring, int sector) {
    const double polar = std::numbers::pi / 3 * ring / num_rings;
    const double around = 2 * std::numbers::pi * sector / num_sectors;
    return Eigen::Vector3d(center + radius_m * Eigen::Vector3d(-std::cos(polar), std::sin(polar) * std::cos(around),
                                                               std::sin(polar) * std::sin(around)));
  };
  MeshBuilder mesh;
  for (int ring = 0; ring < num_rings; ++ring) {
    for (int sector = 0; sector < num_sectors; ++sector) {
      mesh.add_quad(at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1), at(ring, sector + 1));
    }
  }
  return mesh.take();
}

TEST(RayCaster, RangesToPlanesAreExactEvenFarFromTheOrigin) {
  Random random(1);
  for (const Eigen::Vector3d& offset : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(456'000, 5'430'000, 120)}) {
    TriangleMesh mesh = wall(80, 300, offset);
    mesh.vertices_in_world.emplace_back(offset - Eigen::Vector3d(1500, 0, 0));  // the mesh is wide
    const RayCaster caster(mesh);
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector3d direction = Eigen::Vector3d(1, random.normal(), random.normal()).normalized();
      const double expected_m = 80 / direction.x();
      if (expected_m * direction.tail<2>().lpNorm<Eigen::Infinity>() > 299) continue;
      ASSERT_NEAR(caster.cast({offset, direction}), expected_m, 1e-8) << direction.transpose();
    }
  }
}

TEST(RayCaster, RangesToBoxesAreThoseOfTheSlabTest) {
  Random random(2);
  const Eigen::Vector3d low(10, -3, -2);
  const Eigen::Vector3d high(16, 4, 5);
  const RayCaster caster(box_of(low, high));
  int num_hits = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d origin = 4 * random.normal_vector();
    const Eigen::Vector3d direction = (Eigen::Vector3d(13, 0, 1) + 5 * random.normal_vector() - origin).normalized();
    const Eigen::Array3d a = (low - origin).array() / direction.array();
    const Eigen::Array3d b = (high - origin).array() / direction.array();
    const double enter = a.min(b).maxCoeff();
    const double leave = a.max(b).minCoeff();
    if (std::abs(leave - enter) < 1e-3) continue;  // along an edge
    const bool hits = leave > enter && leave > 0;
    const double expected_m = hits ? (enter > 0 ? enter : leave) : kNoReturn;
    num_hits += hits ? 1 : 0;
    const double range_m = caster.cast({origin, direction});
    if (hits) {
      ASSERT_NEAR(range_m, expected_m, 1e-9);
    } else {
      ASSERT_EQ(range_m, kNoReturn);
    }
  }
  EXPECT_GT(num_hits, 1000);
}

TEST(RayCaster, RangesToAFineSphereAreThoseOfTheSphere) {
  constexpr double kRadius_m = 0.25;
  const Eigen::Vector3d center(50, 0, 0);
  const RayCaster caster(cap_of_sphere(center, kRadius_m, 6e-3));
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double beside_m = 0.7 * kRadius_m * random.uniform();  // met at less than 45 degrees
    const double around = 2 * std::numbers::pi * random.uniform();
    const Eigen::Vector3d middle(50, beside_m * std::cos(around), beside_m * std::sin(around));
    const double along_m = middle.norm();
    const Eigen::Vector3d direction = middle / along_m;
    const double b = center.dot(direction);
    const double expected_m = b - std::sqrt(b * b - center.squaredNorm() + kRadius_m * kRadius_m);
    ASSERT_NEAR(caster.cast({Eigen::Vector3d::Zero(), direction}), expected_m, 1e-5);
  }
}

TEST(RayCaster, SeesTheNearestOfSeveralSurfacesFromBothSides) {
  TriangleMesh mesh = wall(5, 1);
  for (const double x : {9.0, 3.0}) {
    const TriangleMesh more = wall(x, 1);
    const auto first = static_cast<std::uint32_t>(mesh.vertices_in_world.size());
    mesh.vertices_in_world.insert(mesh.vertices_in_world.end(), more.vertices_in_world.begin(),
                                  more.vertices_in_world.end());
    for (const auto& t : more.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  const RayCaster caster(mesh);
  EXPECT_NEAR(caster.cast({{0, 0.1, 0.2}, {1, 0, 0}}), 3, 1e-12);
  EXPECT_NEAR(caster.cast({{20, 0.1, 0.2}, {-1, 0, 0}}), 11, 1e-12);
  EXPECT_EQ(caster.cast({{20, 0.1, 0.2}, {1, 0, 0}}), kNoReturn);
}

TEST(RayCaster, HasNoGapBetweenTrianglesThatShareAnEdge) {
  const RayCaster caster(wall(10, 1));
  for (int i = -900; i <= 900; ++i) {
    const Eigen::Vector3d on_diagonal(10, i * 1e-3, i * 1e-3);
    ASSERT_NE(caster.cast({Eigen::Vector3d::Zero(), on_diagonal.normalized()}), kNoReturn) << i;
  }
}

TEST(RayCaster, RaysEndAtTheirRange) {
  const RayCaster caster(wall(10, 1));
  EXPECT_EQ(caster.cast({{0, 0, 0}, {1, 0, 0}}, 9.99), kNoReturn);
  EXPECT_NEAR(caster.cast({{0, 0, 0}, {1, 0, 0}}, 10.01), 10, 1e-12);
}

TEST(RayCaster, ManyRaysAtOnceSeeWhatEachSeesAlone) {
  const RayCaster caster(box_of({-3, -4, -1}, {5, 6, 2}));
  Random random(4);
  for (std::size_t count = 0; count < 40; ++count) {
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) rays.push_back({random.normal_vector(), random.unit_direction()});
    std::vector<double> ranges_m(count, -1);
    caster.cast(rays, 100, ranges_m);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(ranges_m[i], caster.cast(rays[i], 100));
  }
}

TEST(RayCaster, OfAnEmptyMeshHitsNothing) {
  EXPECT_EQ(RayCaster(TriangleMesh{}).cast({{0, 0, 0}, {1, 0, 0}}), kNoReturn);
}

TEST(RayCaster, NeverHitsATriangleWithoutArea) {
  const RayCaster caster({{{5, 0, 0}, {5, 0, 0}, {5, 1, 0}}, {{0, 1, 2}}});
  EXPECT_EQ(caster.cast({{0, 0, 0}, {1, 0, 0}}), kNoReturn);
}

TEST(RayCaster, RefusesInvalidMeshesAndSpansOfDifferentSizes) {
  EXPECT_THROW(RayCaster({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}}), InvalidArgument);
  EXPECT_THROW(RayCaster({{{0, 0, 0}, {1, 0, std::numeric_limits<double>::quiet_NaN()}, {0, 1, 0}}, {{0, 1, 2}}}),
               InvalidArgument);
  const RayCaster caster(wall(1, 1));
  std::vector<double> ranges_m(2);
  EXPECT_THROW(caster.cast(std::vector<Ray>(3), 10, ranges_m), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
