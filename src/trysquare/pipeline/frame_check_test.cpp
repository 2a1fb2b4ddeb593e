// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/frame_check.h"

#include "trysquare/core/handedness.h"
#include "trysquare/pipeline/sensor_trajectory.h"
#include "trysquare/synthetic/street_corner.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace trysquare {
namespace {

/// Turned and shifted as KITTI's Tr is: the axes of a camera, a little tilted, a few decimetres away.
Pose camera_from_lidar() {
  const Eigen::Matrix3d axes = (Eigen::Matrix3d() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished();
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.01, Eigen::Vector3d(1, 1, 0).normalized()).toRotationMatrix();
  return {.rotation = tilt * axes, .translation = {-0.01, -0.05, -0.29}};
}

class CheckFrames : public testing::TestWithParam<double> {
 protected:
  SyntheticSequence truth = simulate_street_corner({.num_scans = 12, .sensor = {.num_beams = 24, .num_azimuths = 300}});
  Trajectory of_camera = sensor_trajectory(truth.trajectory, general_inverse(camera_from_lidar()));

  std::string finding(const Trajectory& trajectory, const std::optional<Pose>& extrinsic = {}) const {
    const std::optional<Diagnostic> found = check_frames(truth.scans, trajectory, extrinsic, GetParam());
    return found ? found->code : "nothing";
  }
};

TEST_P(CheckFrames, FindNothingWrongWithTruePoses) { EXPECT_EQ(finding(truth.trajectory), "nothing"); }

TEST_P(CheckFrames, FindNothingWrongWithCameraPosesAndTheirCalibration) {
  EXPECT_EQ(finding(sensor_trajectory(of_camera, camera_from_lidar()), camera_from_lidar()), "nothing");
}

TEST_P(CheckFrames, NameCameraPosesWithoutCalibration) { EXPECT_EQ(finding(of_camera), "camera_frame"); }

TEST_P(CheckFrames, NameACalibrationThatWasNotNeeded) {
  EXPECT_EQ(finding(sensor_trajectory(truth.trajectory, camera_from_lidar()), camera_from_lidar()),
            "extrinsic_not_needed");
}

TEST_P(CheckFrames, NameAnInvertedCalibration) {
  const Pose inverted = general_inverse(camera_from_lidar());
  EXPECT_EQ(finding(sensor_trajectory(of_camera, inverted), inverted), "extrinsic_inverted");
}

TEST_P(CheckFrames, NameInvertedPoses) {
  Trajectory inverted = truth.trajectory;
  for (Pose& pose : inverted.world_from_scan) pose = general_inverse(pose);
  EXPECT_EQ(finding(inverted), "poses_inverted");
}

TEST_P(CheckFrames, NamePosesOfTheOtherHandedness) {
  EXPECT_EQ(finding(with_y_negated(truth.trajectory)), "left_handed");
}

INSTANTIATE_TEST_SUITE_P(Radii, CheckFrames, testing::Values(0.5, 1.0));

TEST(CheckFramesOfFewScans, FindsNothing) {
  const SyntheticSequence two =
      simulate_street_corner({.num_scans = 2, .sensor = {.num_beams = 8, .num_azimuths = 90}});
  EXPECT_FALSE(check_frames(two.scans, two.trajectory, {}, 1.0));
}

TEST(SensorTrajectory, KeepsTheWorldOrMovesItAlong) {
  const Pose x = camera_from_lidar();
  const Trajectory bodies{.world_from_scan = {Pose{}, {Eigen::Matrix3d::Identity(), {0, 0, 5}}}};
  const Trajectory kept = sensor_trajectory(bodies, x);
  const Trajectory moved = sensor_trajectory_in_sensor_world(bodies, x);
  EXPECT_EQ(kept.world_from_scan[0].translation, x.translation);
  EXPECT_LT(moved.world_from_scan[0].translation.norm(), 1e-15);
  const Eigen::Vector3d step = moved.world_from_scan[1].translation;  // 5 m ahead: z of the camera, x of the LiDAR
  EXPECT_LT((step - Eigen::Vector3d(5, 0, 0)).norm(), 0.1);
}

}  // namespace
}  // namespace trysquare
