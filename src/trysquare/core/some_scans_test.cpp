// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/some_scans.h"

#include "trysquare/synthetic/memory_scans.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace trysquare {
namespace {

using testing::ElementsAre;

Scan scan_with(double x) {
  Scan scan;
  scan.points_in_scan = {{x, 0, 0}};
  return scan;
}

TEST(SomeScans, AreThoseAskedForInTheirOrder) {
  const MemoryScans all({scan_with(0), scan_with(1), scan_with(2)});
  const SomeScans some(all, {2, 0});
  ASSERT_EQ(some.size(), 2U);
  EXPECT_EQ(some.load(0).points_in_scan.front().x(), 2);
  EXPECT_EQ(some.load(1).points_in_scan.front().x(), 0);
  EXPECT_EQ(some.name(0), all.name(2));
  EXPECT_THROW(some.load(2), std::out_of_range);
}

TEST(SomeScans, TakeTheirPosesAndStampsAlong) {
  Trajectory all{.world_from_scan = std::vector<Pose>(3), .stamps_ns = {10, 20, 30}};
  for (std::size_t i = 0; i < 3; ++i) all.world_from_scan[i].translation.x() = static_cast<double>(i);
  const Trajectory some = take(all, {2, 0});
  ASSERT_EQ(some.size(), 2U);
  EXPECT_EQ(some.world_from_scan[0].translation.x(), 2);
  EXPECT_THAT(some.stamps_ns, ElementsAre(30, 10));
  all.stamps_ns.clear();
  EXPECT_TRUE(take(all, {1}).stamps_ns.empty());
}

}  // namespace
}  // namespace trysquare
