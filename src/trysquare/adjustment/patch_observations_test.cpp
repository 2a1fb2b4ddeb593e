// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/patch_observations.h"

#include "trysquare/adjustment/indexed_scans.h"
#include "trysquare/adjustment/plane_patches.h"
#include "trysquare/synthetic/memory_scans.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace trysquare {
namespace {

using testing::ElementsAre;

/// A garden wall across the y axis, 10 cm thick: its faces are at y = 0 and y = 0.1.
struct Wall {
  MemoryScans scans{{}};
  std::vector<Pose> map_from_scan;
};

/// Scans from these places on the y axis, of the face that is towards each.
Wall wall_seen_from(const std::vector<double>& places_m) {
  Wall wall;
  std::vector<Scan> scans;
  for (const double place_m : places_m) {
    const Eigen::Vector3d position(0, place_m, 0);
    wall.map_from_scan.push_back({.translation = position});
    Scan scan;
    for (int i = -5; i <= 5; ++i) {
      for (int j = -5; j <= 5; ++j) {
        const Eigen::Vector3d on_face(0.1 * i, place_m < 0.05 ? 0 : 0.1, 0.1 * j);
        scan.points_in_scan.push_back(on_face - position);
      }
    }
    scans.push_back(std::move(scan));
  }
  wall.scans = MemoryScans(std::move(scans));
  return wall;
}

std::vector<std::uint32_t> observers_of_front(const Wall& wall, const Eigen::Vector3d& normal_in_scan) {
  const std::vector<PlanePatch> patches = {
      {.scan = 0, .center_in_scan = -wall.map_from_scan[0].translation, .normal_in_scan = normal_in_scan}};
  const AdjustmentSettings settings;
  const IndexedScans indexed(wall.scans, settings, {});
  constexpr double kHalfHeight_m = 0.2;
  const std::vector<ObservedPatch> observed =
      observe_patches(patches, indexed, wall.map_from_scan, kHalfHeight_m, settings);
  std::vector<std::uint32_t> scans;
  for (const PatchObservation& each : observed.front().observations) scans.push_back(each.scan);
  return scans;
}

/// The back of a wall is another surface. Whether the normal points to the front or away from it says nothing.
TEST(ObservePatches, LooksAtAPatchFromTheSideThatItWasFoundFrom) {
  const Wall wall = wall_seen_from({-5, -3, 4, -8});
  EXPECT_THAT(observers_of_front(wall, {0, 1, 0}), ElementsAre(0, 1, 3));
  EXPECT_THAT(observers_of_front(wall, {0, -1, 0}), ElementsAre(0, 1, 3));
}

/// A pose that is off by less than the cylinders are high may put a scan beyond the surface that it sees.
TEST(ObservePatches, TrustsPosesToTheHalfHeightOfTheCylinders) {
  Wall wall = wall_seen_from({-5, -0.1, -0.1});
  wall.map_from_scan[1].translation.y() += 0.19;
  EXPECT_THAT(observers_of_front(wall, {0, 1, 0}), ElementsAre(0, 1, 2));
}

}  // namespace
}  // namespace trysquare
