// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/handedness.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

TEST(Handedness, PosesAndPointsAreNegatedTogether) {
  const Pose b_from_a{Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(), {4, -5, 6}};
  std::vector<Eigen::Vector3d> points = {{0.3, -0.2, 7}, {-1, 2, 0}};
  std::vector<Eigen::Vector3d> moved = {b_from_a * points[0], b_from_a * points[1]};
  negate_y(points);
  negate_y(moved);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((with_y_negated(b_from_a) * points[i] - moved[i]).norm(), 1e-14);
  }
  EXPECT_LT(rotation_error(with_y_negated(b_from_a).rotation), 1e-14);
}

TEST(Handedness, TwiceIsOnceNot) {
  const Pose b_from_a{Eigen::AngleAxisd(-2, Eigen::Vector3d(3, 1, 2).normalized()).toRotationMatrix(), {1, 2, 3}};
  const Trajectory twice = with_y_negated(with_y_negated(Trajectory{{b_from_a}, {5}}));
  EXPECT_EQ(twice.world_from_scan[0].rotation, b_from_a.rotation);
  EXPECT_EQ(twice.world_from_scan[0].translation, b_from_a.translation);
  EXPECT_EQ(twice.stamps_ns.at(0), 5);
}

}  // namespace
}  // namespace trysquare
