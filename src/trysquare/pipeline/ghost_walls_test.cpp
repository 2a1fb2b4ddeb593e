// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/ghost_walls.h"

#include "trysquare/synthetic/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace trysquare {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::uint32_t kNumScans = 10;
constexpr double kNoise_m = 0.005;

/// Ten patches along a wall at y = 5, seen by ten scans; `offset_m` says where a scan sees it.
std::vector<ObservedPatch> wall_seen_at(const std::function<double(std::size_t patch, std::uint32_t scan)>& offset_m,
                                        std::uint64_t seed = 1) {
  std::vector<ObservedPatch> patches;
  Random random(seed);
  for (std::size_t i = 0; i < 10; ++i) {
    const double sign = i % 2 == 0 ? 1 : -1;  // normals have no sign
    ObservedPatch patch{
        .center_in_map = {static_cast<double>(i), 5, 1}, .normal_in_map = {0, sign, 0}, .within_scan_sigma_m = 0.02};
    for (std::uint32_t scan = 0; scan < kNumScans; ++scan) {
      patch.observations.push_back({.scan = scan,
                                    .intercept_m = sign * offset_m(i, scan) + kNoise_m * random.normal(),
                                    .variance_m2 = kNoise_m * kNoise_m});
    }
    patches.push_back(patch);
  }
  return patches;
}

double is_moved(std::uint32_t scan) { return scan >= 6 ? 1.0 : 0.0; }

TEST(FindGhostWalls, SayWhereHowFarAndWhichScans) {
  const auto given = wall_seen_at([](std::size_t, std::uint32_t scan) { return 0.1 * is_moved(scan); });
  const auto adjusted = wall_seen_at([](std::size_t, std::uint32_t scan) { return 0.01 * is_moved(scan); });
  const std::vector<GhostWall> walls = find_ghost_walls(given, adjusted);
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_NEAR(walls[0].distance_m, 0.1, 0.005);
  EXPECT_NEAR(walls[0].adjusted_m.value_or(1), 0.01, 0.005);
  EXPECT_LT((walls[0].center_in_map - Eigen::Vector3d(4.5, 5, 1)).norm(), 1e-9);
  EXPECT_NEAR(walls[0].extent_m, 9, 1e-9);
  EXPECT_EQ(walls[0].num_patches, 10U);
  EXPECT_GT(walls[0].normal_in_map.y(), 0.99);
  EXPECT_THAT(walls[0].lower_scans, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(walls[0].upper_scans, ElementsAre(6, 7, 8, 9));
}

TEST(FindGhostWalls, LeaveTheDistanceAtAdjustedPosesEmptyWithoutThem) {
  const auto given = wall_seen_at([](std::size_t, std::uint32_t scan) { return 0.1 * is_moved(scan); });
  const std::vector<GhostWall> walls = find_ghost_walls(given, {});
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_FALSE(walls[0].adjusted_m);
}

TEST(FindGhostWalls, AcceptAWallThatAllScansSeeInOnePlace) {
  EXPECT_THAT(find_ghost_walls(wall_seen_at([](std::size_t, std::uint32_t) { return 0; }), {}), IsEmpty());
}

TEST(FindGhostWalls, AcceptAWallThatIsLessThanFiveCentimetresApart) {
  const auto given = wall_seen_at([](std::size_t, std::uint32_t scan) { return 0.04 * is_moved(scan); });
  EXPECT_THAT(find_ghost_walls(given, {}), IsEmpty());
}

TEST(FindGhostWalls, AcceptErrorsOfPosesWithoutTwoGroups) {
  int num_alarms = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {  // the same error of a scan on all patches, as poses make it
    Random random(seed, 7);
    std::vector<double> errors_m;
    for (std::uint32_t scan = 0; scan < kNumScans; ++scan) errors_m.push_back(0.05 * random.normal());
    const auto given = wall_seen_at([&](std::size_t, std::uint32_t scan) { return errors_m[scan]; }, seed);
    num_alarms += find_ghost_walls(given, {}).empty() ? 0 : 1;
  }
  EXPECT_LE(num_alarms, 2);  // one in a hundred; 21 of 200 without a look at the order of the scans
}

TEST(FindGhostWalls, FindThoseOfTwoSensorsThatTakeTurns) {
  const auto given = wall_seen_at([](std::size_t, std::uint32_t scan) { return scan % 2 == 0 ? 0.1 : 0.0; });
  EXPECT_EQ(find_ghost_walls(given, {}).size(), 1U);
}

TEST(FindGhostWalls, AcceptASteadyDrift) {
  const auto given = wall_seen_at([](std::size_t, std::uint32_t scan) { return 0.03 * scan; });
  EXPECT_THAT(find_ghost_walls(given, {}), IsEmpty());
}

// In a simulated street every facade had a ghost at its foot: some scans see the ground in the patch, which moves their
// mean by decimetres. Their points scatter as far.
TEST(FindGhostWalls, AcceptTheFootOfAWall) {
  auto given = wall_seen_at([](std::size_t, std::uint32_t scan) { return 0.15 * is_moved(scan); });
  for (ObservedPatch& patch : given) patch.within_scan_sigma_m = 0.1;
  EXPECT_THAT(find_ghost_walls(given, {}), IsEmpty());
}

TEST(FindGhostWalls, AcceptFewPatchesAmongManyThatAreWhole) {
  const auto given =
      wall_seen_at([](std::size_t patch, std::uint32_t scan) { return patch < 3 ? 0.1 * is_moved(scan) : 0.0; });
  EXPECT_THAT(find_ghost_walls(given, {}), IsEmpty());
}

TEST(FindGhostWalls, AcceptPatchesThatContradictEachOther) {
  const auto given = wall_seen_at([](std::size_t patch, std::uint32_t scan) {
    return (scan + 3 * patch) % kNumScans < 5 ? 0.1 : 0.0;  // other scans on every patch
  });
  EXPECT_THAT(find_ghost_walls(given, {}), IsEmpty());
}

}  // namespace
}  // namespace trysquare
