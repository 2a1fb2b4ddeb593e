// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/axes_check.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/trajectory_test_examples.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using test::disturbed;
using test::winding;

/// Points of a camera (x right, y down, z forward) in the axes of its body (x forward, y left, z up).
Eigen::Matrix3d body_from_camera() { return (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished(); }

Trajectory moved_on_its_body(Trajectory trajectory, const Pose& body_from_sensor) {
  for (Pose& pose : trajectory.world_from_scan) pose = pose * body_from_sensor;
  return trajectory;
}

/// A car on a plane: forward is x, it turns about z.
Trajectory drive(int n, double turn_rad) {
  Trajectory trajectory;
  Pose pose;
  for (int i = 0; i < n; ++i) {
    trajectory.world_from_scan.push_back(pose);
    pose = pose * Pose{Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {1, 0, 0}};
  }
  return trajectory;
}

TEST(AxesCheck, FindsACameraComparedWithItsBodyInAnotherWorldAtAnotherScale) {
  const Trajectory body = winding(100);
  Trajectory camera = moved_on_its_body(body, {body_from_camera(), Eigen::Vector3d::Zero()});
  const Eigen::Matrix3d other_world = Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (Pose& pose : camera.world_from_scan) {
    pose = Pose{other_world, {5, 6, 7}} * Pose{pose.rotation, 0.1 * pose.translation};
  }
  const auto found = renamed_axes(body, disturbed(camera, 0.05));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->reference_from_estimate, body_from_camera());
  EXPECT_GT(found->translation_cosine, 0.99);
  EXPECT_GT(found->rotation_cosine, 0.99);
  EXPECT_LT(found->given_rotation_cosine, 0.5);
}

TEST(AxesCheck, FindsItOnAPlaneAndWithASensorBesideTheMiddleAndTilted) {
  const Trajectory body = drive(300, 0.02);
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const auto found = renamed_axes(body, moved_on_its_body(body, {body_from_camera() * tilt, {0.5, 0.3, 1.5}}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->reference_from_estimate, body_from_camera());
}

TEST(AxesCheck, SaysWhichExtrinsicMendsIt) {
  const Trajectory body = winding(50);
  const Trajectory camera = moved_on_its_body(body, {body_from_camera(), Eigen::Vector3d::Zero()});
  const auto warning = check_axes(body, camera);
  ASSERT_TRUE(warning);
  EXPECT_EQ(warning->code, "renamed_axes");
  EXPECT_THAT(warning->message, testing::HasSubstr("x = z, y = -x, z = -y of the estimate"));
  EXPECT_THAT(warning->message, testing::HasSubstr("--extrinsic \"0 0 1 0 -1 0 0 0 0 -1 0 0\""));
}

TEST(AxesCheck, LeavesEqualFramesAloneHoweverBadTheEstimate) {
  const Trajectory truth = winding(100);
  for (const double size : {0.0, 0.1, 1.0, 10.0}) EXPECT_FALSE(renamed_axes(truth, disturbed(truth, size))) << size;
}

TEST(AxesCheck, LeavesASensorAloneThatIsTurnedALittleOnItsBody) {
  const Trajectory body = winding(100);
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0.6, 0.8)}) {
    const Pose turned{Eigen::AngleAxisd(0.7, axis).toRotationMatrix(), {0.2, 0, 0}};
    EXPECT_FALSE(renamed_axes(body, moved_on_its_body(body, turned))) << axis.transpose();
  }
}

TEST(AxesCheck, IsSilentWhereThereIsTooLittleToTell) {
  const Pose camera{body_from_camera(), Eigen::Vector3d::Zero()};
  EXPECT_TRUE(renamed_axes(winding(11), moved_on_its_body(winding(11), camera)));
  EXPECT_FALSE(renamed_axes(winding(10), moved_on_its_body(winding(10), camera)));
  EXPECT_FALSE(renamed_axes(winding(1), winding(1)));
  const Trajectory still{std::vector<Pose>(50), {}};
  EXPECT_FALSE(renamed_axes(still, still));
  EXPECT_FALSE(renamed_axes(still, winding(50)));
  EXPECT_THROW(renamed_axes(winding(2), winding(3)), InvalidArgument);
}

TEST(AxesCheck, FindsTheDirectionOfALineThoughNothingTurns) {
  const Trajectory line = drive(50, 0);
  const auto found = renamed_axes(line, moved_on_its_body(line, {body_from_camera(), Eigen::Vector3d::Zero()}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->reference_from_estimate.row(0), Eigen::RowVector3d(0, 0, 1));
}

}  // namespace
}  // namespace trysquare
