// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/planar_patches.h"

#include "trysquare/core/error.h"
#include "trysquare/metrics/metrics_test_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

namespace trysquare {
namespace {

constexpr double kRadiusM = 1.0;

RegisteredMap one_scan(std::vector<Eigen::Vector3d> points) {
  RegisteredMap map{.points_in_map = std::move(points), .num_scans = 1};
  map.scan_of_point.assign(map.points_in_map.size(), 0);
  return map;
}

/// Gaussian noise of the given standard deviations about points that are uniform on a square of 4 m edge.
std::vector<Eigen::Vector3d> noisy_square(const Eigen::Vector3d& sigma_m, double width_m, std::size_t count = 2000) {
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> noise;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d error = sigma_m.cwiseProduct(Eigen::Vector3d(noise(rng), noise(rng), noise(rng)));
    points.push_back(Eigen::Vector3d(4 * uniform(rng), width_m * uniform(rng), 0) + error);
  }
  return points;
}

std::size_t num_patches(const RegisteredMap& map, const PlanarPatchSettings& settings = {}) {
  return planar_patches(map, kRadiusM, settings).patches.size();
}

void expect_equal(const std::vector<PlanarPatch>& a, const std::vector<PlanarPatch>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].center_in_map, b[i].center_in_map);
    EXPECT_EQ(a[i].normal_in_map, b[i].normal_in_map);
    EXPECT_EQ(a[i].eigenvalues, b[i].eigenvalues);
    EXPECT_EQ(a[i].scan, b[i].scan);
    EXPECT_EQ(a[i].num_points, b[i].num_points);
  }
}

// 60 points of 1 cm noise on a disc of 0.6 m: the normal's standard deviation is 0.01 / (0.3 · √60) = 0.0043; at the
// border of a wall the disc is a quarter, and one in 10⁴ is allowed.
TEST(PlanarPatches, HaveTheNormalsOfTheirWalls) {
  const PlanarPatches found = planar_patches(test::three_walls(0.01, 1000).map, kRadiusM);
  std::array<std::size_t, 3> on_wall{};
  for (const PlanarPatch& patch : found.patches) {
    Eigen::Index axis = 0;
    patch.center_in_map.cwiseAbs().minCoeff(&axis);
    ++on_wall[static_cast<std::size_t>(axis)];
    EXPECT_GT(std::abs(patch.normal_in_map[axis]), std::cos(0.06));
    EXPECT_NEAR(std::sqrt(patch.eigenvalues[0]), 0.01, 0.006);
  }
  for (const std::size_t count : on_wall) EXPECT_GT(count, 150u);  // of 16 · 16 voxels, some without points
}

TEST(PlanarPatches, AreCenteredOnPointsOfTheirScans) {
  const RegisteredMap map = test::three_walls(0.01, 1000).map;
  for (const PlanarPatch& patch : planar_patches(map, kRadiusM).patches) {
    bool is_there = false;
    for (std::size_t i = 0; i < map.points_in_map.size(); ++i) {
      is_there = is_there || (map.points_in_map[i] == patch.center_in_map && map.scan_of_point[i] == patch.scan);
    }
    EXPECT_TRUE(is_there);
  }
}

TEST(PlanarPatches, AreOnePerVoxelAtMost) {
  const PlanarPatches found = planar_patches(test::three_walls(0.01, 1000).map, kRadiusM, {.spacing = 0.4});
  std::set<std::array<double, 3>> voxels;
  for (const PlanarPatch& patch : found.patches) {
    const Eigen::Vector3d voxel = (patch.center_in_map / 0.4).array().floor();
    EXPECT_TRUE(voxels.insert({voxel.x(), voxel.y(), voxel.z()}).second);
  }
  EXPECT_GT(found.num_planar, found.patches.size());
  EXPECT_GE(found.num_candidates, found.num_planar);
}

// 1 mm thick and 1 cm wide: 100 λ₁ = λ₂, as flat as can be, and its normal means nothing.
TEST(PlanarPatches, AreNotLines) {
  const RegisteredMap ring = one_scan(noisy_square({0, 0.01, 0.001}, 0));
  EXPECT_EQ(num_patches(ring), 0u);
  EXPECT_GT(num_patches(ring, {.line_ratio = 0}), 10u);
}

TEST(PlanarPatches, AreNotThick) {
  const RegisteredMap hedge = one_scan(noisy_square({0, 0, 0.12}, 4));
  EXPECT_EQ(num_patches(hedge, {.planarity_ratio = 1}), 0u);
  EXPECT_GT(num_patches(hedge, {.planarity_ratio = 1, .max_thickness = 0.2}), 100u);
}

TEST(PlanarPatches, AreFlat) {
  const RegisteredMap rough = one_scan(noisy_square({0, 0, 0.07}, 4));  // λ₂ / λ₁ = 0.3² / 0.07² = 18
  EXPECT_LT(num_patches(rough), num_patches(rough, {.planarity_ratio = 10}) / 2);
}

TEST(PlanarPatches, NeedEnoughPoints) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 14; ++i) points.emplace_back(0.1 * std::cos(i), 0.1 * std::sin(i), 0.0);
  EXPECT_EQ(num_patches(one_scan(points)), 0u);
  points.emplace_back(0, 0, 0);
  EXPECT_GT(num_patches(one_scan(points)), 0u);
}

// A pose error of 0.5 m tears the walls apart; patches come from single scans and do not notice.
TEST(PlanarPatches, DoNotSufferFromPoseErrors) {
  RegisteredMap map = test::three_walls(0.01, 1000, 2).map;
  for (std::size_t i = 0; i < map.points_in_map.size(); ++i) {
    if (map.scan_of_point[i] == 1) map.points_in_map[i] += Eigen::Vector3d::Constant(0.3);
  }
  const PlanarPatches found = planar_patches(map, kRadiusM);
  EXPECT_GT(static_cast<double>(found.num_planar), 0.95 * static_cast<double>(found.num_candidates));
}

TEST(PlanarPatches, AreTheFlattestOfTheirVoxels) {
  RegisteredMap map = test::three_walls(0.03, 1000, 2).map;
  for (std::size_t i = 0; i < map.points_in_map.size(); ++i) {  // the second scan is less noisy
    if (map.scan_of_point[i] == 0) continue;
    Eigen::Index axis = 0;
    map.points_in_map[i].cwiseAbs().minCoeff(&axis);
    map.points_in_map[i][axis] /= 10;
  }
  const PlanarPatches found = planar_patches(map, kRadiusM, {.spacing = 1});
  const auto num_second = std::count_if(found.patches.begin(), found.patches.end(),
                                        [](const PlanarPatch& patch) { return patch.scan == 1; });
  EXPECT_GT(num_second, 0.8 * static_cast<double>(found.patches.size()));
}

TEST(PlanarPatches, ComeFromScansThatAreEvenlySpread) {
  const RegisteredMap map = test::three_walls(0.01, 1000, 5).map;
  const auto scans = [&](std::size_t num_scans) {
    std::set<std::uint32_t> seen;
    for (const PlanarPatch& patch : planar_patches(map, kRadiusM, {.num_scans = num_scans}).patches)
      seen.insert(patch.scan);
    return seen;
  };
  EXPECT_EQ(scans(1), (std::set<std::uint32_t>{0}));
  EXPECT_EQ(scans(3), (std::set<std::uint32_t>{0, 2, 4}));
  EXPECT_EQ(scans(9), (std::set<std::uint32_t>{0, 1, 2, 3, 4}));
}

// Half as large is exact in binary: every number is, to the bit, half or a quarter. About half of the patches are
// thin enough, so that every length decides.
TEST(PlanarPatches, ScaleWithTheRadius) {
  const test::Scene scene = test::three_walls(0.06, 600, 2);
  const test::Scene half = test::transformed(scene, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 0.5);
  const PlanarPatchSettings settings{.planarity_ratio = 2, .max_thickness = 0.06};
  const PlanarPatches expected = planar_patches(scene.map, kRadiusM, settings);
  PlanarPatches found = planar_patches(half.map, kRadiusM / 2, settings);
  for (PlanarPatch& patch : found.patches) {
    patch.center_in_map *= 2;
    patch.eigenvalues *= 4;
  }
  EXPECT_GT(found.patches.size(), 100u);
  EXPECT_LT(found.num_planar, 0.8 * static_cast<double>(found.num_candidates));
  expect_equal(found.patches, expected.patches);
}

TEST(PlanarPatches, DoNotDependOnTheOrderOfThePointsOfAScan) {
  RegisteredMap map = test::three_walls(0.01, 1000, 1).map;
  const PlanarPatches before = planar_patches(map, kRadiusM);
  std::shuffle(map.points_in_map.begin(), map.points_in_map.end(), std::mt19937(9));
  expect_equal(planar_patches(map, kRadiusM).patches, before.patches);
}

TEST(PlanarPatches, DoNotDependOnTheNumberOfThreads) {
  const RegisteredMap map = test::three_walls(0.01, 1000).map;
  expect_equal(planar_patches(map, kRadiusM, {}, {.num_threads = 1}).patches,
               planar_patches(map, kRadiusM, {}, {.num_threads = 4}).patches);
}

TEST(PlanarPatches, OfNothingAreNone) {
  const PlanarPatches found = planar_patches({}, kRadiusM);
  EXPECT_TRUE(found.patches.empty());
  EXPECT_EQ(found.num_candidates, 0u);
}

TEST(PlanarPatchesArguments, AreCheckedWithNameValueAndRange) {
  try {
    planar_patches({}, 1, {.line_ratio = 1});
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(), "planar patches: line_ratio = 1 is out of range: it must be in [0, 1)");
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(planar_patches({}, 0), InvalidArgument);
  EXPECT_THROW(planar_patches({}, kInfinity), InvalidArgument);
  EXPECT_THROW(planar_patches({}, 1, {.num_scans = 0}), InvalidArgument);
  EXPECT_THROW(planar_patches({}, 1, {.patch_radius = 0}), InvalidArgument);
  EXPECT_THROW(planar_patches({}, 1, {.spacing = -1}), InvalidArgument);
  EXPECT_THROW(planar_patches({}, 1, {.planarity_ratio = 0}), InvalidArgument);
  EXPECT_THROW(planar_patches({}, 1, {.max_thickness = kInfinity}), InvalidArgument);
  EXPECT_THROW(planar_patches({}, 1, {.min_points = 3}), InvalidArgument);
  EXPECT_THROW(planar_patches(one_scan({{0, std::nan(""), 0}}), 1), InvalidArgument);
  EXPECT_THROW(planar_patches({.points_in_map = {{0, 0, 0}}, .num_scans = 1}, 1), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
