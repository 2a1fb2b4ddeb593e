// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/parse_trajectory.h"

#include "trysquare/io/internal/test_files.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using internal::io_error_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using enum TrajectoryFormat;

std::string error_of(const std::string& text, TrajectoryFormat format) {
  return io_error_of([&] { parse_trajectory(text, "p.txt", format); });
}

std::vector<std::string> warnings_of(const std::string& text, TrajectoryFormat format) {
  std::vector<std::string> codes;
  for (const Diagnostic& warning : parse_trajectory(text, "p.txt", format).warnings) codes.push_back(warning.code);
  return codes;
}

/// 0.6 0.8 0 and so on: a rotation about z by atan2(0.8, 0.6), exact in decimals.
const std::string kTurnedRow = "0.6 -0.8 0 1.00001 0.8 0.6 0 2.00001 0 0 1 3.00001\n";
Eigen::Matrix3d turned() { return (Eigen::Matrix3d() << 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1).finished(); }
const Eigen::Vector3d kPosition(1.00001, 2.00001, 3.00001);

TEST(ParseTum, ReadsStampPositionAndQuaternion) {
  const Trajectory trajectory = parse_tum(
      "# timestamp tx ty tz qx qy qz qw\n1311868164.363181 1.00001 2.00001 3.00001 0 0 0.4472135955 0.894427191\n",
      "p.txt");
  ASSERT_EQ(trajectory.size(), 1U);
  EXPECT_THAT(trajectory.stamps_ns, ElementsAre(1311868164363181000));
  EXPECT_EQ(trajectory.world_from_scan[0].translation, kPosition);
  EXPECT_LT((trajectory.world_from_scan[0].rotation - turned()).norm(), 1e-10);
}

TEST(ParseTum, NormalisesQuaternionsLikeAnIndependentConversion) {
  const Trajectory trajectory = parse_tum("0 0 0 0 0.1 -0.2 0.3 0.927\n", "p.txt");
  const Eigen::Matrix3d expected = Eigen::Quaterniond(0.927, 0.1, -0.2, 0.3).normalized().toRotationMatrix();
  EXPECT_LT((trajectory.world_from_scan[0].rotation - expected).norm(), 1e-15);
}

TEST(ParseEuroc, HasTheRealPartFirstAndIgnoresFurtherColumns) {
  const std::string line = "1403715524907143168,1.00001,2.00001,3.00001,0.894427191,0,0,0.4472135955";
  for (const std::string& text : {"#timestamp, p_RS_R_x [m]\r\n" + line + "\r\n", line + ",9,9,9,-1e-5,x?\n"}) {
    const Trajectory trajectory = parse_euroc(text, "p.csv");
    EXPECT_THAT(trajectory.stamps_ns, ElementsAre(1403715524907143168));
    EXPECT_EQ(trajectory.world_from_scan[0].translation, kPosition);
    EXPECT_LT((trajectory.world_from_scan[0].rotation - turned()).norm(), 1e-10);
  }
}

TEST(ParseKitti, KeepsTheNumbersAsTheyAre) {
  const Trajectory trajectory = parse_kitti(
      "9.999978e-01 5.272628e-04 -2.066935e-03 -4.690294e-02 -5.296506e-04 9.999992e-01 -1.154865e-03 "
      "-2.839928e-02 2.066324e-03 1.155958e-03 9.999971e-01 8.586941e-01\n",
      "p.txt");
  EXPECT_TRUE(trajectory.stamps_ns.empty());
  const Pose& pose = trajectory.world_from_scan.at(0);
  EXPECT_EQ(pose.rotation, (Eigen::Matrix3d() << 9.999978e-01, 5.272628e-04, -2.066935e-03, -5.296506e-04, 9.999992e-01,
                            -1.154865e-03, 2.066324e-03, 1.155958e-03, 9.999971e-01)
                               .finished());
  EXPECT_EQ(pose.translation, Eigen::Vector3d(-4.690294e-02, -2.839928e-02, 8.586941e-01));
}

TEST(ParseMatrices, ReadsRowsAndFlatMatrices) {
  const std::string rows = "0.6 -0.8 0 1.00001\n0.8 0.6 0 2.00001\n0 0 1 3.00001\n";
  const std::string flat = "0.6,-0.8,0,1.00001,0.8,0.6,0,2.00001,0,0,1,3.00001";
  for (const std::string& text : {rows, rows + "0 0 0 1\n", rows + "0 0 0 1\n\n# next\n" + rows + "0 0 0 1.0000001\n",
                                  flat, flat + ",0,0,0,1\n" + flat + ",0,0,0,1\n"}) {
    const Trajectory trajectory = parse_matrices(text, "p.txt");
    for (const Pose& pose : trajectory.world_from_scan) {
      EXPECT_EQ(pose.rotation, turned());
      EXPECT_EQ(pose.translation, kPosition);
    }
  }
  EXPECT_EQ(parse_matrices(rows + "0 0 0 1\n" + rows + "0 0 0 1\n", "p.txt").size(), 2U);
}

TEST(ParseTrajectory, RefusesWrongNumbersOfValues) {
  EXPECT_EQ(error_of("0 0 0 0 0 0 0 1\n\n1 0 0 0 0 0 0\n", kTum),
            "p.txt: line 3: found 7 values, expected 8: t x y z qx qy qz qw");
  EXPECT_EQ(error_of("0,0,0,0,1,0,0\n", kEuroc),
            "p.txt: line 1: found 7 values, expected 8 or more: t x y z qw qx qy qz");
  EXPECT_EQ(error_of(kTurnedRow + "1 0 0 0\n", kKitti),
            "p.txt: line 2: found 4 values, expected 12, a 3×4 matrix row by row");
  EXPECT_EQ(error_of("1 0 0\n", kMatrices),
            "p.txt: line 1: found 3 values, expected a row of 4, or a matrix of 16 (or 12)");
  EXPECT_EQ(error_of("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 0 0 0\n", kMatrices),
            "p.txt: line 5: found 5 rows of 4 numbers in all, expected 4 for each matrix");
}

TEST(ParseTrajectory, RefusesTextAndEmptyFields) {
  EXPECT_EQ(error_of("0 0 zero 0 0 0 0 1\n", kTum), "p.txt: line 1: value 3 is \"zero\", expected a number");
  EXPECT_EQ(error_of("0,0,,0,1,0,0,0\n", kEuroc), "p.txt: line 1: value 3 is \"\", expected a number");
  EXPECT_EQ(error_of("noon 0 0 0 0 0 0 1\n", kTum),
            "p.txt: line 1: value 1 is \"noon\", expected a time stamp in seconds");
  EXPECT_EQ(error_of("nan,0,0,0,1,0,0,0\n", kEuroc),
            "p.txt: line 1: value 1 is \"nan\", expected a time stamp in nanoseconds");
  EXPECT_EQ(error_of("1 0 0 x\n", kMatrices), "p.txt: line 1: value 4 is \"x\", expected a number");
}

TEST(ParseTrajectory, RefusesFilesWithoutPoses) {
  for (const TrajectoryFormat format : {kTum, kKitti, kEuroc}) {
    EXPECT_EQ(error_of("# nothing\n", format), "p.txt: line 1: found no poses, expected one or more");
  }
  EXPECT_EQ(error_of("", kMatrices), "p.txt: line 1: found no numbers, expected a matrix");
}

TEST(ParseTrajectory, RefusesPosesThatAreNotFinite) {
  EXPECT_EQ(error_of("0 0 0 0 0 0 0 1\n1 0 nan 0 0 0 0 1\n", kTum),
            "p.txt: line 2: number 2 of the pose is nan, expected finite numbers");
  EXPECT_EQ(error_of("1 0 0 inf 0 1 0 0 0 0 1 0\n", kKitti),
            "p.txt: line 1: number 4 of the pose is inf, expected finite numbers");
  EXPECT_EQ(error_of("1 0 0 0\n0 nan 0 0\n0 0 1 0\n0 0 0 1\n", kMatrices),
            "p.txt: line 1: number 6 of the pose is nan, expected finite numbers");
  EXPECT_EQ(error_of("0 0 0 0 0 nan 0 1\n", kTum), "p.txt: line 1: the quaternion has the norm nan, expected 1");
}

TEST(ParseTrajectory, RefusesQuaternionsThatAreNone) {
  EXPECT_EQ(error_of("0 0 0 0 0 0 0 0\n", kTum), "p.txt: line 1: the quaternion has the norm 0, expected 1");
  EXPECT_EQ(error_of("0 0 0 0 0 0 0 0.97\n", kTum), "p.txt: line 1: the quaternion has the norm 0.97, expected 1");
  EXPECT_EQ(error_of("0,0,0,0,1.03,0,0,0\n", kEuroc), "p.txt: line 1: the quaternion has the norm 1.03, expected 1");
}

TEST(ParseTrajectory, RefusesMatricesThatAreNoRotations) {
  EXPECT_EQ(error_of(kTurnedRow + "1.001 0 0 0 0 1 0 0 0 0 1 0\n", kKitti),
            "p.txt: line 2: the 3×3 part is no rotation: RᵀR differs from I by 0.002, expected less than 0.001");
  EXPECT_EQ(error_of("1 0 0 0 0 1 0 0 0 0 -1 0\n", kKitti),
            "p.txt: line 1: the 3×3 part is no rotation: its determinant is -1, expected 1");
  EXPECT_THAT(error_of("0 0 0 0 0 0 0 0 0 0 0 0\n", kKitti), HasSubstr("its determinant is 0, expected 1"));
}

TEST(ParseTrajectory, RefusesOtherLastRows) {
  EXPECT_EQ(error_of("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1.001\n", kMatrices),
            "p.txt: line 1: the last row of the matrix is 0 0 0 1.001, expected 0 0 0 1");
}

TEST(ParseTrajectory, WarnsOfRotationsThatAreSlightlyOff) {
  const std::string slightly = "1.0001 0 0 0 0 1 0 0 0 0 1 0\n";
  EXPECT_THAT(warnings_of("1.000004 0 0 0 0 1 0 0 0 0 1 0\n", kKitti), IsEmpty());
  const TrajectoryFile file = parse_trajectory(kTurnedRow + slightly + slightly, "p.txt", kKitti);
  ASSERT_THAT(file.warnings, SizeIs(1));
  EXPECT_EQ(file.warnings[0].code, "rotation_not_orthonormal");
  EXPECT_EQ(file.warnings[0].message,
            "p.txt: line 2 and 1 more: rotations are off: RᵀR differs from I by up to 0.0002; the numbers are used as "
            "they are");
  EXPECT_EQ(file.trajectory.world_from_scan[1].rotation(0, 0), 1.0001);
}

TEST(ParseTrajectory, WarnsOnceOfQuaternionsThatAreSlightlyOff) {
  EXPECT_THAT(warnings_of("0 0 0 0 0 0 0 1.0009\n", kTum), IsEmpty());
  EXPECT_THAT(warnings_of("0 0 0 0 0 0 0 1.0011\n1 0 0 0 0 0 0 0.99\n", kTum), ElementsAre("non_unit_quaternion"));
}

TEST(ParseTrajectory, WarnsOfRoundedPositions) {
  const std::string fine = "0 0.12345 0 0 0 0 0 1\n";
  const std::string rounded = "1 0.1234 0.1 0 0 0 0 1\n";
  EXPECT_THAT(warnings_of(rounded, kTum), IsEmpty());
  EXPECT_THAT(warnings_of(fine + rounded, kTum), IsEmpty());
  EXPECT_THAT(warnings_of("0 1 2 3 0 0 0 1\n1 0 0 0 0 0 0 1\n", kTum), IsEmpty());
  EXPECT_THAT(warnings_of("0 1.0 0.000 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", kTum), IsEmpty());
  EXPECT_THAT(warnings_of("0 0.5 0 0 0 0 0 1\n" + rounded, kTum), ElementsAre("rounded_poses"));
  EXPECT_THAT(warnings_of("0,0.5,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n", kEuroc), ElementsAre("rounded_poses"));
  EXPECT_THAT(warnings_of("1 0 0 0.5 0 1 0 0 0 0 1 0\n1 0 0 0.25 0 1 0 0 0 0 1 0\n", kKitti),
              ElementsAre("rounded_poses"));
  EXPECT_THAT(warnings_of(kTurnedRow + kTurnedRow, kKitti), IsEmpty());
  const std::string matrix = "1 0 0 0.5\n0 1 0 0\n0 0 1 0\n0.000000 0.000000 0.000000 1.000000\n";
  EXPECT_THAT(warnings_of(matrix + matrix, kMatrices), ElementsAre("rounded_poses"));
}

TEST(ParseTrajectory, WarnsOfTimeThatStandsStillOrRunsBack) {
  const std::string rest = " 0 0 0 0 0 0 1\n";
  EXPECT_THAT(warnings_of("1" + rest + "2" + rest, kTum), IsEmpty());
  EXPECT_THAT(warnings_of("1" + rest + "1" + rest, kTum), ElementsAre("time_stamps_not_increasing"));
  const TrajectoryFile file = parse_trajectory("3" + rest + "2" + rest + "1" + rest, "p.txt", kTum);
  ASSERT_THAT(file.warnings, SizeIs(1));
  EXPECT_EQ(file.warnings[0].message, "p.txt: line 2 and 1 more: the time stamp is not later than the one before it");
}

TEST(TrajectoryFormatNames, GoBothWays) {
  for (const TrajectoryFormat format : {kTum, kKitti, kEuroc, kMatrices}) {
    EXPECT_EQ(trajectory_format_named(name_of(format)), format);
  }
  EXPECT_EQ(name_of(kMatrices), "matrix");
  EXPECT_EQ(trajectory_format_named("auto"), std::nullopt);
}

}  // namespace
}  // namespace trysquare
