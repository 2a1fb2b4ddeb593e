// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/projection.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

Pose tilted(double roll, double pitch, double yaw) {
  return {(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
              .toRotationMatrix(),
          {1, 2, 3}};
}

TEST(Projected, KeepsTheAngleAboutTheNormalAndTheTwoCoordinates) {
  const Trajectory trajectory{{tilted(0.1, -0.2, 2.5)}, {7}};
  const auto on = [&](Plane plane) { return projected(trajectory, plane).world_from_scan[0]; };
  EXPECT_LT((on(Plane::kXy).rotation - tilted(0, 0, 2.5).rotation).norm(), 1e-15);
  EXPECT_LT((on(Plane::kXz).rotation - tilted(0, -0.2, 0).rotation).norm(), 1e-15);
  EXPECT_LT((on(Plane::kYz).rotation - tilted(0.1, 0, 0).rotation).norm(), 1e-15);
  EXPECT_EQ(on(Plane::kXy).translation, Eigen::Vector3d(1, 2, 0));
  EXPECT_EQ(on(Plane::kXz).translation, Eigen::Vector3d(1, 0, 3));
  EXPECT_EQ(on(Plane::kYz).translation, Eigen::Vector3d(0, 2, 3));
  EXPECT_EQ(projected(trajectory, Plane::kXy).stamps_ns.at(0), 7);
}

TEST(Projected, PlanesAreFoundByTheirNames) {
  for (const Plane plane : {Plane::kXy, Plane::kXz, Plane::kYz}) EXPECT_EQ(plane_named(name_of(plane)), plane);
  EXPECT_FALSE(plane_named("zx").has_value());
}

}  // namespace
}  // namespace trysquare
