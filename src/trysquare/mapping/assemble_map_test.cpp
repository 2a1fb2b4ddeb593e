// SPDX-License-Identifier: Apache-2.0
#include "trysquare/mapping/assemble_map.h"

#include "trysquare/core/error.h"
#include "trysquare/mapping/exact_duplicates.h"
#include "trysquare/synthetic/memory_scans.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace trysquare {
namespace {

MemoryScans three_scans() {
  return MemoryScans({{.points_in_scan = {{1, 0, 0}, {0, 2, 0}}, .num_not_finite = 3, .num_at_origin = 1},
                      {.points_in_scan = {{0, 0, 3}}, .num_at_origin = 2},
                      {.points_in_scan = {{4, 0, 0}, {5, 0, 0}, {6, 0, 0}}}});
}

Trajectory three_poses() {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  return {.world_from_scan = {{turn, {1, 2, 3}}, {turn * turn, {4, 5, 6}}, {turn.transpose(), {7, 8, 9}}}};
}

TEST(AssembleMap, LeavesTheFirstScanWhereItIs) {
  const RegisteredMap map = assemble_map(three_scans(), three_poses()).map;
  EXPECT_LT((map.points_in_map[0] - Eigen::Vector3d(1, 0, 0)).norm(), 1e-14);
  EXPECT_LT((map.points_in_map[1] - Eigen::Vector3d(0, 2, 0)).norm(), 1e-14);
}

TEST(AssembleMap, KeepsTheWayBackToTheWorld) {
  const Trajectory trajectory = three_poses();
  const RegisteredMap map = assemble_map(three_scans(), trajectory).map;
  const Eigen::Vector3d in_world = trajectory.world_from_scan[2] * Eigen::Vector3d(5, 0, 0);
  EXPECT_LT((map.world_from_map * map.points_in_map[4] - in_world).norm(), 1e-13);
}

TEST(AssembleMap, KeepsTheOrderOfScansAndPoints) {
  const RegisteredMap map = assemble_map(three_scans(), three_poses()).map;
  EXPECT_EQ(map.scan_of_point, (std::vector<std::uint32_t>{0, 0, 1, 2, 2, 2}));
  EXPECT_EQ(map.num_scans, 3u);
}

TEST(AssembleMap, CountsWhatTheReadersDropped) {
  const AssembledMap assembled = assemble_map(three_scans(), three_poses());
  EXPECT_EQ(assembled.num_not_finite, 3u);
  EXPECT_EQ(assembled.num_at_origin, 3u);
}

TEST(AssembleMap, LeavesOutPointsBeyondTheRanges) {
  const AssembledMap assembled = assemble_map(three_scans(), three_poses(), {.min_range_m = 2, .max_range_m = 5});
  EXPECT_EQ(assembled.map.points_in_map.size(), 4u);
  EXPECT_EQ(assembled.num_out_of_range, 2u);
}

TEST(AssembleMap, OfAWindowStartsInTheFrameOfItsFirstScan) {
  const RegisteredMap map = assemble_map(three_scans(), three_poses(), {.first_scan = 1, .num_scans = 2}).map;
  EXPECT_LT((map.points_in_map[0] - Eigen::Vector3d(0, 0, 3)).norm(), 1e-14);
  EXPECT_EQ(map.scan_of_point, (std::vector<std::uint32_t>{0, 1, 1, 1}));
}

TEST(AssembleMap, KeepsEveryNthPointOfEachScan) {
  const RegisteredMap map = assemble_map(three_scans(), three_poses(), {.keep_every = 2}).map;
  EXPECT_EQ(map.scan_of_point, (std::vector<std::uint32_t>{0, 1, 2, 2}));
}

TEST(AssembleMap, IsBitIdenticalForEveryNumberOfThreads) {
  const RegisteredMap one = assemble_map(three_scans(), three_poses(), {}, {.num_threads = 1}).map;
  const RegisteredMap three = assemble_map(three_scans(), three_poses(), {}, {.num_threads = 3}).map;
  EXPECT_EQ(one.points_in_map, three.points_in_map);
}

// UTM: coordinates of the world are 5e6 m large, where doubles are 9e-10 m apart. Were points moved to the world first,
// they would be rounded to that; formed pose first, only the pose is.
TEST(AssembleMap, KeepsPointsExactInUtmCoordinates) {
  Trajectory utm = three_poses();
  for (Pose& pose : utm.world_from_scan) pose.translation += Eigen::Vector3d(500'000, 5'000'000, 0);
  const RegisteredMap map = assemble_map(three_scans(), utm).map;
  EXPECT_LT((map.points_in_map[1] - Eigen::Vector3d(0, 2, 0)).norm(), 2e-9);
  const double between_points_of_one_scan = (map.points_in_map[5] - map.points_in_map[3]).norm();
  EXPECT_NEAR(between_points_of_one_scan, 2.0, 1e-13);
}

TEST(AssembleMap, OfNoScansIsEmpty) {
  EXPECT_TRUE(assemble_map(MemoryScans({}), Trajectory{}).map.points_in_map.empty());
}

TEST(AssembleMapArguments, RefuseDifferentNumbersOfScansAndPoses) {
  Trajectory two = three_poses();
  two.world_from_scan.pop_back();
  EXPECT_THROW(assemble_map(three_scans(), two), InvalidArgument);
}

TEST(AssembleMapArguments, RefusePosesThatAreNotRotations) {
  Trajectory bad = three_poses();
  bad.world_from_scan[1].rotation *= 1.001;
  EXPECT_THROW(assemble_map(three_scans(), bad), InvalidArgument);
  bad.world_from_scan[1].rotation.setConstant(std::nan(""));
  EXPECT_THROW(assemble_map(three_scans(), bad), InvalidArgument);
}

TEST(AssembleMapArguments, RefusePosesThatAreNotFinite) {
  Trajectory bad = three_poses();
  bad.world_from_scan[2].translation.x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(assemble_map(three_scans(), bad), InvalidArgument);
}

TEST(AssembleMapArguments, RefuseRangesThatContainNothing) {
  EXPECT_THROW(assemble_map(three_scans(), three_poses(), {.min_range_m = 5, .max_range_m = 4}), InvalidArgument);
  EXPECT_THROW(assemble_map(three_scans(), three_poses(), {.min_range_m = -1}), InvalidArgument);
}

TEST(CountExactDuplicates, CountsCopiesBeyondTheFirst) {
  const std::vector<Eigen::Vector3d> points = {{1, 2, 3}, {1, 2, 4}, {1, 2, 3}, {0, 2, 3}, {1, 2, 3}, {1, 2, 4}};
  EXPECT_EQ(count_exact_duplicates(points), 3u);
  EXPECT_EQ(count_exact_duplicates({}), 0u);
}

}  // namespace
}  // namespace trysquare
