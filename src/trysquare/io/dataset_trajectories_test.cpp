// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/io/internal/test_files.h"
#include "trysquare/io/parse_trajectory.h"
#include "trysquare/io/trajectory_file.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace trysquare {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const Eigen::Matrix3d kQuarterTurn = (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();

std::string message_of(const std::string& text, TrajectoryFormat format) {
  try {
    parse_trajectory(text, "f", format);
    return "it was read";
  } catch (const IoError& error) {
    return error.what();
  }
}

/// The first pose: a quarter turn about z at (1, 2.25, 3).
void expect_example(const TrajectoryFile& file) {
  EXPECT_LT((file.trajectory.world_from_scan.at(0).rotation - kQuarterTurn).norm(), 1e-9);
  EXPECT_EQ(file.trajectory.world_from_scan.at(0).translation, Eigen::Vector3d(1, 2.25, 3));
}

TEST(NcltTrajectory, HasMicrosecondsAndAngles) {
  const auto file = parse_trajectory(
      "1326030975726043, nan, nan, nan, nan, nan, nan\n1326030975726043, 1, 2.25, 3, 0, 0, 1.5707963267948966\n", "f",
      TrajectoryFormat::kNclt);
  expect_example(file);
  EXPECT_THAT(file.trajectory.stamps_ns, ElementsAre(1326030975726043000));
  EXPECT_THAT(message_of("1,2,3\n", TrajectoryFormat::kNclt), HasSubstr("f: line 1: found 3 values, expected 7"));
}

TEST(NcltTrajectory, AnglesAreRollPitchYaw) {
  const auto file = parse_trajectory("1326030975726043,0,0,0,0.1,-0.2,0.3\n", "f", TrajectoryFormat::kNclt);
  const Eigen::Vector3d angles = file.trajectory.world_from_scan.at(0).rotation.eulerAngles(2, 1, 0);
  EXPECT_LT((angles - Eigen::Vector3d(0.3, -0.2, 0.1)).norm(), 1e-15);
}

TEST(MulranTrajectory, HasATimeAndAMatrix) {
  const auto file =
      parse_trajectory("1561000444390857630,0,-1,0,1,1,0,0,2.25,0,0,1,3\n", "f", TrajectoryFormat::kMulran);
  expect_example(file);
  EXPECT_EQ(file.trajectory.world_from_scan[0].rotation, kQuarterTurn);
  EXPECT_THAT(file.trajectory.stamps_ns, ElementsAre(1561000444390857630));
  EXPECT_THAT(message_of("1561000444390857630,1,2\n", TrajectoryFormat::kMulran), HasSubstr("expected 13"));
  EXPECT_THAT(message_of("x,0,-1,0,1,1,0,0,2,0,0,1,3\n", TrajectoryFormat::kMulran), HasSubstr("value 1 is \"x\""));
}

TEST(NewerCollegeTrajectory, HasSecondsAndNanoseconds) {
  const auto file = parse_trajectory(
      "#sec,nsec,x,y,z,qx,qy,qz,qw\n1583836591,182590976,1,2.25,3,0,0,0.7071067811865476,0.7071067811865476\n", "f",
      TrajectoryFormat::kNewerCollege);
  expect_example(file);
  EXPECT_THAT(file.trajectory.stamps_ns, ElementsAre(1583836591182590976));
  EXPECT_THAT(message_of("1583836591,1000000000,1,2,3,0,0,0,1\n", TrajectoryFormat::kNewerCollege),
              HasSubstr("value 2 is \"1000000000\", expected nanoseconds below a second"));
  EXPECT_THAT(message_of("1.5,0,1,2,3,0,0,0,1\n", TrajectoryFormat::kNewerCollege), HasSubstr("value 1 is \"1.5\""));
}

TEST(G2oTrajectory, HasTheVerticesInTheirOrderAndNothingElse) {
  const auto file = parse_trajectory(
      "FIX 0\nVERTEX_SE3:QUAT 7 1 2.25 3 0 0 0.7071067811865476 0.7071067811865476\n"
      "EDGE_SE3:QUAT 7 2 0 0 0 0 0 0 1 1 0 0\nVERTEX_SE3:QUAT 2 4 5 6 0 0 0 1\n",
      "f", TrajectoryFormat::kG2o);
  ASSERT_EQ(file.trajectory.size(), 2u);
  expect_example(file);
  EXPECT_TRUE(file.trajectory.stamps_ns.empty());
  EXPECT_THAT(message_of("EDGE_SE3:QUAT 1 2\n", TrajectoryFormat::kG2o), HasSubstr("found no poses"));
  EXPECT_THAT(message_of("VERTEX_SE3:QUAT 1 2\n", TrajectoryFormat::kG2o), HasSubstr("f: line 1: found 3 values"));
}

TEST(BalmTrajectory, HasTheTimeInTheCorner) {
  const auto file =
      parse_trajectory("0,-1,0,1,\n1,0,0,2.25,\n0,0,1,3,\n0,0,0,1583836591.25,\n", "f", TrajectoryFormat::kBalm);
  expect_example(file);
  EXPECT_THAT(file.trajectory.stamps_ns, ElementsAre(1583836591250000000));
  EXPECT_THAT(message_of("0,-1,0,1\n1,0,0,2\n", TrajectoryFormat::kBalm),
              HasSubstr("f: line 2: the last matrix has 2 rows"));
  EXPECT_THAT(message_of("0,-1,0,1\n1,0,0,2\n0,0,1,3\n0,0,1,5\n", TrajectoryFormat::kBalm), HasSubstr("last row"));
}

TEST(DatasetTrajectories, AreToldByTheirFirstLine) {
  const internal::TemporaryFolder folder;
  const auto format_of = [&](const std::string& name, const std::string& text) {
    return read_trajectory(folder.add(name, text).string()).format;
  };
  EXPECT_EQ(format_of("a.csv", "1326030975726043, 1, 2, 3, 0, 0, 0\n"), TrajectoryFormat::kNclt);
  EXPECT_EQ(format_of("a.csv", "1561000444390857630,0,-1,0,1,1,0,0,2,0,0,1,3\n"), TrajectoryFormat::kMulran);
  EXPECT_EQ(format_of("a.csv", "1583836591,182590976,1,2,3,0,0,0,1\n"), TrajectoryFormat::kNewerCollege);
  EXPECT_EQ(format_of("a.g2o", "VERTEX_SE3:QUAT 7 1 2 3 0 0 0 1\n"), TrajectoryFormat::kG2o);
  EXPECT_EQ(format_of("a.csv", "1,0,0,1\n0,1,0,2\n0,0,1,3\n0,0,0,12.5\n"), TrajectoryFormat::kBalm);
  EXPECT_EQ(format_of("alidarPose.csv", "1,0,0,1\n0,1,0,2\n0,0,1,3\n0,0,0,1\n"), TrajectoryFormat::kBalm);
  EXPECT_EQ(format_of("a.txt", "1 0 0 1\n0 1 0 2\n0 0 1 3\n0 0 0 1\n"), TrajectoryFormat::kMatrices);
  EXPECT_EQ(format_of("a.csv", "1403715524907143168,1,2,3,1,0,0,0,9,9,9,9,9\n"), TrajectoryFormat::kEuroc);
}

}  // namespace
}  // namespace trysquare
