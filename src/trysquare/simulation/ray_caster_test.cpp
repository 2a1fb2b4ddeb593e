// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/ray_caster.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

namespace trysquare {
namespace {

TEST(RayCaster, OfAnEmptyMeshHitsNothing) {
  EXPECT_EQ(RayCaster(TriangleMesh{}).cast({{0, 0, 0}, {1, 0, 0}}), kNoReturn);
}

TEST(RayCaster, SeesATriangle) {
  const RayCaster caster({{{5, -1, -1}, {5, 1, -1}, {5, 0, 2}}, {{0, 1, 2}}});
  EXPECT_EQ(caster.cast({{0, 0, 0}, {1, 0, 0}}), 5);
}

}  // namespace
}  // namespace trysquare
