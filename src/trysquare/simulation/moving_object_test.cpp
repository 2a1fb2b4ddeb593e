// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/moving_object.h"

#include <gtest/gtest.h>

namespace trysquare {
namespace {

TEST(MovingObject, MovesAlongItsPathAtItsSpeedAndLooksAhead) {
  const MovingObject car{.path_in_world = {{0, 0, 1}, {0, 100, 1}}, .start_m = 10, .speed_mps = 5};
  const Pose pose = car.world_from_object(4);
  EXPECT_LT((pose.translation - Eigen::Vector3d(0, 30, 1)).norm(), 1e-12);
  EXPECT_LT((pose.rotation.col(0) - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT(rotation_error(pose.rotation), 1e-14);
}

TEST(MovingObject, BeginsAnOpenPathAgainAndGoesAroundAClosedOne) {
  const MovingObject open{.path_in_world = {{0, 0, 0}, {40, 0, 0}}, .speed_mps = 1};
  EXPECT_LT((open.world_from_object(50).translation - Eigen::Vector3d(10, 0, 0)).norm(), 1e-12);
  const MovingObject closed{.path_in_world = {{0, 0, 0}, {40, 0, 0}, {40, 40, 0}, {0, 40, 0}, {0, 0, 0}},
                            .speed_mps = 1};
  EXPECT_LT((closed.world_from_object(180).translation - Eigen::Vector3d(20, 0, 0)).norm(), 1e-12);
  EXPECT_LT((closed.world_from_object(159.9999).rotation - closed.world_from_object(160.0001).rotation).norm(), 1e-3);
}

TEST(MovingObject, GoesBackwardsInTime) {
  const MovingObject open{.path_in_world = {{0, 0, 0}, {40, 0, 0}}, .speed_mps = 1};
  EXPECT_LT((open.world_from_object(-10).translation - Eigen::Vector3d(30, 0, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace trysquare
