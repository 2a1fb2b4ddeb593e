// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/kitti_sequence_writer.h"

#include "trysquare/io/calibration.h"
#include "trysquare/io/file.h"
#include "trysquare/io/internal/test_files.h"
#include "trysquare/io/scan_files.h"
#include "trysquare/io/trajectory_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using internal::io_error_of;
using internal::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<Eigen::Vector3d> kPoints = {{1, 2, 3}, {-4, 5, 0.5}};

Trajectory two_poses() {
  Pose second;
  second.translation = {1, 0.25, 0};
  return {{Pose{}, second}, {0, 100'000'001}};
}

void write_sequence(const std::filesystem::path& folder, bool replaces = false) {
  KittiSequenceWriter writer(folder, replaces);
  writer.write_scan(0, kPoints);
  writer.write_scan(1, kPoints);
  writer.finish(two_poses());
}

TEST(KittiSequenceWriter, WritesWhatTheReadersRead) {
  const TemporaryFolder folder;
  write_sequence(folder.path() / "new" / "out/");
  const std::filesystem::path out = folder.path() / "new" / "out";
  const ScanFiles scans = open_scans(out.string());
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_EQ(scans.load(1).points_in_scan, kPoints);
  EXPECT_THAT(scans.stamps_ns(), ElementsAre(0, 100'000'001));
  EXPECT_EQ(read_trajectory((out / "poses.txt").string()).trajectory.world_from_scan[1].translation,
            two_poses().world_from_scan[1].translation);
  EXPECT_EQ(read_kitti_calibration(out / "calib.txt").rotation, Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
}

TEST(KittiSequenceWriter, GivesScansWithoutTimeStampsOneASecond) {
  const TemporaryFolder folder;
  KittiSequenceWriter writer(folder.path() / "out");
  writer.finish({std::vector<Pose>(2), {}});
  EXPECT_EQ(read_file(folder.path() / "out" / "times.txt"), "0.000000000\n1.000000000\n");
}

TEST(KittiSequenceWriter, LeavesNothingOfASequenceThatWasNotFinished) {
  const TemporaryFolder folder;
  {
    const KittiSequenceWriter writer(folder.path() / "out");
    writer.write_scan(0, kPoints);
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(KittiSequenceWriter, LeavesNothingWhenTheSequenceCannotBeFinished) {
  const TemporaryFolder folder;
  {
    KittiSequenceWriter writer(folder.path() / "out");
    EXPECT_THROW(writer.finish({}), InvalidArgument);
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(KittiSequenceWriter, ShowsNothingBeforeItIsFinished) {
  const TemporaryFolder folder;
  KittiSequenceWriter writer(folder.path() / "out");
  writer.write_scan(0, kPoints);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
  writer.finish(two_poses());
  EXPECT_THAT(folder.names(), ElementsAre("out"));
}

TEST(KittiSequenceWriter, RefusesAFolderWithSomethingInIt) {
  const TemporaryFolder folder;
  folder.add("out/mine.txt", "mine");
  folder.add("file", "");
  EXPECT_THAT(io_error_of([&] { write_sequence(folder.path() / "out"); }), HasSubstr("exists and is not empty"));
  EXPECT_THAT(io_error_of([&] { write_sequence(folder.path() / "file"); }), HasSubstr("it is a file"));
  EXPECT_EQ(read_file(folder.path() / "out" / "mine.txt"), "mine");
}

TEST(KittiSequenceWriter, ReplacesASequenceButNothingElse) {
  const TemporaryFolder folder;
  folder.add("out/mine.txt", "mine");
  folder.add("out/poses.txt", "old");
  folder.add("out/velodyne/000007.bin", "old");
  write_sequence(folder.path() / "out", true);
  EXPECT_EQ(open_scans((folder.path() / "out").string()).size(), 2U);
  EXPECT_EQ(read_trajectory((folder.path() / "out" / "poses.txt").string()).trajectory.size(), 2U);
  EXPECT_EQ(read_file(folder.path() / "out" / "mine.txt"), "mine");
  EXPECT_THAT(folder.names(), ElementsAre("out"));
}

TEST(KittiSequenceWriter, TakesAnEmptyFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "out");
  write_sequence(folder.path() / "out");
  EXPECT_EQ(open_scans((folder.path() / "out").string()).size(), 2U);
}

}  // namespace
}  // namespace trysquare
