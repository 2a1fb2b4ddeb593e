// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/write_trajectory.h"

#include "trysquare/io/internal/test_files.h"
#include "trysquare/io/trajectory_file.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace trysquare {
namespace {

using internal::TemporaryFolder;
using testing::ElementsAre;
using testing::StartsWith;
using enum TrajectoryFormat;

Trajectory example() {
  Trajectory trajectory;
  for (const double angle : {0.1, 1.0, 3.0, std::numbers::pi}) {
    const Eigen::AngleAxisd turn(angle, Eigen::Vector3d(1, -2, 0.5).normalized());
    trajectory.world_from_scan.push_back({turn.toRotationMatrix(), {angle / 3, 5e5 + angle, -5e6 / 7}});
  }
  trajectory.stamps_ns = {-1500000001, 0, 1, 1403715524907143168};
  return trajectory;
}

Trajectory written_and_read(const Trajectory& trajectory, TrajectoryFormat format) {
  const TemporaryFolder folder;
  write_trajectory(folder.path() / "p.txt", trajectory, format);
  return read_trajectory((folder.path() / "p.txt").string(), format).trajectory;
}

TEST(WriteTrajectory, MatricesComeBackBitByBit) {
  Trajectory trajectory = example();
  trajectory.world_from_scan[0].rotation *= 1.0000001;  // as KITTI's files are
  for (const TrajectoryFormat format : {kKitti, kMatrices}) {
    const Trajectory read = written_and_read(trajectory, format);
    ASSERT_EQ(read.size(), trajectory.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_EQ(read.world_from_scan[i].rotation, trajectory.world_from_scan[i].rotation);
      EXPECT_EQ(read.world_from_scan[i].translation, trajectory.world_from_scan[i].translation);
    }
  }
}

TEST(WriteTrajectory, QuaternionsComeBackToRoundOffAndStampsExactly) {
  const Trajectory trajectory = example();
  for (const TrajectoryFormat format : {kTum, kEuroc}) {
    const Trajectory read = written_and_read(trajectory, format);
    EXPECT_EQ(read.stamps_ns, trajectory.stamps_ns);
    ASSERT_EQ(read.size(), trajectory.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_LT((read.world_from_scan[i].rotation - trajectory.world_from_scan[i].rotation).norm(), 2e-15);
      EXPECT_EQ(read.world_from_scan[i].translation, trajectory.world_from_scan[i].translation);
    }
  }
}

TEST(WriteTrajectory, IsToldApartWhenReadBack) {
  const TemporaryFolder folder;
  Trajectory trajectory = example();
  trajectory.stamps_ns = {1403715524907143168, 1403715524907143169, 1403715524907143170, 1403715524907143171};
  for (const TrajectoryFormat format : {kTum, kKitti, kEuroc, kMatrices}) {
    write_trajectory(folder.path() / "p.txt", trajectory, format);
    EXPECT_EQ(read_trajectory((folder.path() / "p.txt").string()).format, format);
  }
}

TEST(FormatTrajectory, CountsSecondsWhenThereAreNoStamps) {
  Trajectory trajectory = example();
  trajectory.stamps_ns.clear();
  EXPECT_THAT(parse_tum(format_trajectory(trajectory, kTum), "").stamps_ns,
              ElementsAre(0, 1000000000, 2000000000, 3000000000));
}

TEST(FormatTrajectory, PrintsStampsInSeconds) {
  Trajectory trajectory{{Pose{}}, {-1500000001}};
  EXPECT_EQ(format_trajectory(trajectory, kTum), "# timestamp tx ty tz qx qy qz qw\n-1.500000001 0 0 0 0 0 0 1\n");
  trajectory.stamps_ns = {-5};
  EXPECT_THAT(format_trajectory(trajectory, kTum), testing::HasSubstr("\n-0.000000005 0"));
}

TEST(FormatTrajectory, RefusesTrajectoriesThatAreNone) {
  EXPECT_THROW(format_trajectory({}, kKitti), InvalidArgument);
  EXPECT_THROW(format_trajectory({{Pose{}, Pose{}}, {1}}, kKitti), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
