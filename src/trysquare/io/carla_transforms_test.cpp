// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/core/handedness.h"
#include "trysquare/io/internal/carla_rows.h"
#include "trysquare/io/parse_trajectory.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace trysquare {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;

TrajectoryFile parse(const std::string& text) { return parse_trajectory(text, "f", TrajectoryFormat::kCarla); }

/// The right-handed rotation (y left) of CARLA's angles, as its bridge to ROS has it: yaw and pitch change their sign.
Eigen::Matrix3d right_handed(double roll_deg, double pitch_deg, double yaw_deg) {
  return (Eigen::AngleAxisd(-yaw_deg * kDegree, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(-pitch_deg * kDegree, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll_deg * kDegree, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

void expect_is_example(const TrajectoryFile& file) {
  ASSERT_EQ(file.trajectory.size(), 2u);
  EXPECT_THAT(file.frames, ElementsAre(7, 12));
  const Trajectory poses = with_y_negated(file.trajectory);
  EXPECT_LT((poses.world_from_scan[0].rotation - right_handed(10, 20, -30)).norm(), 1e-15);
  EXPECT_LT((poses.world_from_scan[1].rotation - right_handed(-1, 2.5, 170)).norm(), 1e-15);
  EXPECT_EQ(poses.world_from_scan[0].translation, Eigen::Vector3d(1, -2.25, 3));
}

TEST(CarlaTransforms, AreReadFromCsvByTheNamesOfTheColumns) {
  expect_is_example(parse("frame,x,y,z,roll,pitch,yaw\r\n7,1,2.25,3,10,20,-30\r\n12,4.123456,5,6,-1,2.5,170\r\n"));
  expect_is_example(parse("# Yaw Pitch Roll Frame X Y Z speed\n-30 20 10 7 1 2.25 3 99\n170 2.5 -1 12 4 5 6 99\n"));
}

TEST(CarlaTransforms, AreReadFromJsonInEachOfItsShapes) {
  expect_is_example(parse(R"([{"frame": 7, "x": 1, "y": 2.25, "z": 3, "roll": 10, "pitch": 20, "yaw": -30},
                              {"frame": 12, "x": 4, "y": 5, "z": 6, "roll": -1, "pitch": 2.5, "yaw": 170}])"));
  expect_is_example(parse(R"([{"frame": 7, "location": {"x": 1, "y": 2.25, "z": 3},
                               "rotation": {"roll": 10, "pitch": 20, "yaw": -30}},
                              {"frame": 12, "transform": {"location": {"x": 4, "y": 5, "z": 6},
                               "rotation": {"roll": -1, "pitch": 2.5, "yaw": 170}}}])"));
  expect_is_example(parse(R"({"12": {"x": 4, "y": 5, "z": 6, "roll": -1, "pitch": 2.5, "yaw": 170},
                              "7": {"x": 1, "y": 2.25, "z": 3, "roll": 10, "pitch": 20, "yaw": -30}})"));
}

TEST(CarlaTransforms, MatricesStayAsTheyWereWritten) {
  const std::string numbers = "0 -1 0 1 1 0 0 2 0 0 1 3 0 0 0 1";
  const TrajectoryFile csv =
      parse("frame m00 m01 m02 m03 m10 m11 m12 m13 m20 m21 m22 m23 m30 m31 m32 m33\n3 " + numbers + "\n");
  const TrajectoryFile nested = parse(R"([{"frame": 3, "matrix": [[0,-1,0,1],[1,0,0,2],[0,0,1,3],[0,0,0,1]]}])");
  const TrajectoryFile flat = parse(R"([{"frame": 3, "transform": [0,-1,0,1,1,0,0,2,0,0,1,3,0,0,0,1]}])");
  for (const TrajectoryFile& file : {csv, nested, flat}) {
    EXPECT_EQ(file.trajectory.world_from_scan.at(0).rotation,
              (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished());
    EXPECT_EQ(file.trajectory.world_from_scan.at(0).translation, Eigen::Vector3d(1, 2, 3));
    EXPECT_THAT(file.frames, ElementsAre(3));
  }
}

TEST(CarlaTransforms, TimesAreReadWhereTheyAre) {
  EXPECT_THAT(parse("frame,timestamp,x,y,z,roll,pitch,yaw\n7,0.05,0,0,0,0,0,0\n").trajectory.stamps_ns,
              ElementsAre(50'000'000));
  EXPECT_THAT(parse(R"([{"frame": 1, "timestamp": 2.5, "x": 0, "y": 0, "z": 0, "roll": 0, "pitch": 0, "yaw": 0}])")
                  .trajectory.stamps_ns,
              ElementsAre(2'500'000'000));
}

TEST(CarlaTransforms, AreToldFromOtherFormatsByTheirFirstLine) {
  EXPECT_TRUE(internal::looks_like_carla("\xEF\xBB\xBF\n[{}]"));
  EXPECT_TRUE(internal::looks_like_carla("frame, x, y, z, roll, pitch, yaw\n"));
  EXPECT_FALSE(internal::looks_like_carla("# timestamp tx ty tz qx qy qz qw\n1 2 3 4 0 0 0 1\n"));
  EXPECT_FALSE(internal::looks_like_carla("1 0 0 0 0 1 0 0 0 0 1 0\n"));
}

TEST(CarlaTransforms, RefusesWhatIsMissingOrTwiceAndSaysWhere) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      parse(text);
      return "it was read";
    } catch (const IoError& error) {
      return error.what();
    }
  };
  EXPECT_THAT(message("frame,x,y,z,roll,pitch\n"), HasSubstr("f: line 1: the header has no column yaw"));
  EXPECT_THAT(message("frame,x,y,z,roll,pitch,yaw\n7,0,0,0,0,0,0\n7,0,0,0,0,0,0\n"),
              HasSubstr("f: line 3: frame 7 has a pose already"));
  EXPECT_THAT(message("frame,x,y,z,roll,pitch,yaw\n7,0,0,0,0,0\n"), HasSubstr("f: line 2: found 6 values, expected 7"));
  EXPECT_THAT(message("frame,x,y,z,roll,pitch,yaw\n7.5,0,0,0,0,0,0\n"), HasSubstr("f: line 2: frame is \"7.5\""));
  EXPECT_THAT(message("frame,x,y,z,roll,pitch,yaw\n7,0,0,a,0,0,0\n"), HasSubstr("f: line 2: z is \"a\""));
  EXPECT_THAT(message(R"([{"frame": 1, "x": 0}])"), HasSubstr("f: item 1: found no number y"));
  EXPECT_THAT(message(R"([{"x": 0}])"), HasSubstr("f: item 1: found no frame"));
  EXPECT_THAT(message(R"({"a": {}})"), HasSubstr("f: byte 0: found the key \"a\""));
  EXPECT_THAT(message(R"([{"frame": 1, "matrix": [1, 2]}])"), HasSubstr("f: item 1: matrix has 2 numbers"));
  EXPECT_THAT(message(R"([{"frame": 1, ])"), HasSubstr("f: byte 14: it is no JSON"));
  EXPECT_THAT(message("[]"), HasSubstr("f: line 1: found no poses"));
  EXPECT_THAT(message(R"([{"frame": 1, "timestamp": 2, "x": 0, "y": 0, "z": 0, "roll": 0, "pitch": 0, "yaw": 0},
                          {"frame": 2, "x": 0, "y": 0, "z": 0, "roll": 0, "pitch": 0, "yaw": 0}])"),
              HasSubstr("found 1 time stamps for 2 poses"));
}

}  // namespace
}  // namespace trysquare
