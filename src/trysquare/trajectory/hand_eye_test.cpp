// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/hand_eye.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/trajectory_test_examples.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using test::disturbed;
using test::winding;

const Pose kBodyFromSensor{Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix(),
                           {0.3, -0.1, 1.7}};

/// The same run, told by the sensor, in a world of its own.
Trajectory of_sensor(const Trajectory& world_from_body) {
  const Pose other_from_world{Eigen::AngleAxisd(-2, Eigen::Vector3d(3, 1, 2).normalized()).toRotationMatrix(),
                              {100, 20, -3}};
  Trajectory result = world_from_body;
  for (Pose& pose : result.world_from_scan) pose = other_from_world * pose * kBodyFromSensor;
  return result;
}

TEST(HandEye, FindsWhereTheSensorSits) {
  const Trajectory body = winding(60);
  const HandEye found = hand_eye(body, of_sensor(body));
  EXPECT_LT((found.body_from_sensor.rotation - kBodyFromSensor.rotation).norm(), 1e-12);
  EXPECT_LT((found.body_from_sensor.translation - kBodyFromSensor.translation).norm(), 1e-11);
  EXPECT_LT(found.translation_rms_m, 1e-11);
  EXPECT_LT(found.rotation_rms_rad, 1e-11);
}

TEST(HandEye, ComesCloseWithNoisyPosesAndSaysHowWellTheyFit) {
  const Trajectory body = winding(400);
  const HandEye found = hand_eye(body, disturbed(of_sensor(body), 0.1));  // up to 5 mrad and 2 cm an axis
  EXPECT_LT((found.body_from_sensor.rotation - kBodyFromSensor.rotation).norm(), 2e-3);
  EXPECT_LT((found.body_from_sensor.translation - kBodyFromSensor.translation).norm(), 2e-2);
  EXPECT_GT(found.translation_rms_m, 5e-3);
}

TEST(HandEye, RefusesMotionsInAPlaneAndStandingStill) {
  Trajectory flat;
  for (int i = 0; i < 50; ++i) {
    flat.world_from_scan.push_back(
        {Eigen::AngleAxisd(0.1 * i, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {1.0 * i, 0, 0}});
  }
  EXPECT_THROW(hand_eye(flat, of_sensor(flat)), InvalidArgument);
  const Trajectory still{std::vector<Pose>(9), {}};
  EXPECT_THROW(hand_eye(still, still), InvalidArgument);
  EXPECT_THROW(hand_eye(winding(1), winding(1)), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
