// SPDX-License-Identifier: Apache-2.0
#include "trysquare/experiments/simulated_drive.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

#include <string>

namespace trysquare {
namespace {

TEST(SimulatedDrive, HasScansOfThirtyTwoBeamsAboutAMetreApart) {
  for (const char* scene : {"street", "town-grid", "town-suburb", "town-old"}) {
    const auto scans = simulated_drive(scene, 1, 4);
    ASSERT_EQ(scans->size(), 4u) << scene;
    EXPECT_GT(scans->load(0).points_in_scan.size(), 32u * 720 / 2) << scene;
    const std::vector<Pose>& poses = scans->true_poses().world_from_scan;
    for (std::size_t i = 1; i < 4; ++i) {
      EXPECT_NEAR((poses[i].translation - poses[i - 1].translation).norm(), 1, 0.4) << scene;
    }
  }
}

TEST(SimulatedDrive, IsTheSameForTheSameSeedAndTheBeginningOfALongerOne) {
  const auto scans = simulated_drive("town-old", 5, 3);
  const auto longer = simulated_drive("town-old", 5, 6);
  EXPECT_EQ(longer->load(2).points_in_scan, scans->load(2).points_in_scan);
  EXPECT_NE(simulated_drive("town-old", 6, 3)->load(2).points_in_scan, scans->load(2).points_in_scan);
}

TEST(SimulatedDrive, RefusesAnUnknownScene) { EXPECT_THROW(simulated_drive("moon", 1, 3), InvalidArgument); }

TEST(ExtractionAlongDrive, LooksAtEveryScanByItself) {
  const std::vector<OrthogonalWindow> windows = extraction_along_drive("town-grid", 1, 5, 1.0);
  ASSERT_EQ(windows.size(), 5u);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    EXPECT_EQ(windows[i].first, i);
    EXPECT_EQ(windows[i].last, i);
    EXPECT_EQ(windows[i].directions.size(), 3u) << windows[i].reason;
  }
}

}  // namespace
}  // namespace trysquare
