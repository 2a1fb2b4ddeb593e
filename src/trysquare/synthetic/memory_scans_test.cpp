// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/memory_scans.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

namespace trysquare {
namespace {

TEST(MemoryScans, GivesBackTheScansInTheirOrder) {
  Scan first;
  first.points_in_scan = {{1, 2, 3}};
  Scan second;
  second.stamp_ns = 7;
  const MemoryScans scans({first, second});
  EXPECT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans.load(0).points_in_scan, first.points_in_scan);
  EXPECT_EQ(scans.load(1).stamp_ns, 7);
  EXPECT_EQ(scans.name(1), "scan 1");
}

TEST(MemoryScans, RefusesAnIndexOutOfRange) { EXPECT_THROW(MemoryScans({}).load(0), InvalidArgument); }

}  // namespace
}  // namespace trysquare
