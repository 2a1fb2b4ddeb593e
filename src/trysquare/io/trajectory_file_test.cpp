// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/trajectory_file.h"

#include "trysquare/io/internal/test_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using internal::io_error_of;
using internal::real_data;
using internal::TemporaryFolder;
using testing::HasSubstr;
using testing::StartsWith;
using enum TrajectoryFormat;

constexpr const char* kIdentity = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

std::string translated(int x) { return "1 0 0 " + std::to_string(x) + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"; }

TEST(ReadTrajectory, TellsTheFormatByTheValues) {
  const TemporaryFolder folder;
  const auto format_of = [&](const std::string& name, const std::string& text) {
    return read_trajectory(folder.add(name, text).string()).format;
  };
  EXPECT_EQ(format_of("a.txt", "\xEF\xBB\xBF# poses\n\n1.5 0 0 0 0 0 0 1\n"), kTum);
  EXPECT_EQ(format_of("a.txt", "7 0 0 0 0 0 0 1\n"), kTum);
  EXPECT_EQ(format_of("a.csv", "1.5,0,0,0,0,0,0,1\r\n"), kTum);
  EXPECT_EQ(format_of("a.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n"), kKitti);
  EXPECT_EQ(format_of("a.txt", "1403715524907143168 0 0 0 1 0 0 0\n"), kEuroc);
  EXPECT_EQ(format_of("a.txt", "1403715524907143168,0,0,0,1,0,0,0,9,9,9,9\n"), kEuroc);
  EXPECT_EQ(format_of("a.csv", "5000000,0,0,0,1,0,0,0,9\n"), kEuroc);
  EXPECT_EQ(format_of("a.txt", kIdentity), kMatrices);
  EXPECT_EQ(format_of("a.txt", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"), kMatrices);
}

TEST(ReadTrajectory, AsksWhenTheFormatCannotBeTold) {
  const TemporaryFolder folder;
  const std::string path = folder.add("a.csv", "#\n5,0,0,0,1,0,0,0\n").string();
  EXPECT_EQ(io_error_of([&] { read_trajectory(path); }),
            path +
                ": line 2: found 8 values, beginning with \"5\", from which the format cannot be told; expected 8 "
                "(tum: t x y "
                "z qx qy qz qw), 12 (kitti), 8 or more beginning with nanoseconds (euroc), 4 or 16 (matrix), 7 "
                "beginning with microseconds (nclt), 13 beginning with nanoseconds (mulran), 9 beginning with sec nsec "
                "(newer-college), VERTEX_SE3:QUAT (g2o); name the format with --poses-format");
  EXPECT_EQ(read_trajectory(path, kEuroc).trajectory.stamps_ns.at(0), 5);
  for (const char* text : {"1 2 3\n", "hello\n", "1 0 0 0 0 1 0 0 0 0 1 0 0\n"}) {
    EXPECT_THAT(io_error_of([&] { read_trajectory(folder.add("b.txt", text).string()); }), HasSubstr("--poses-format"))
        << text;
  }
}

TEST(ReadTrajectory, RefusesFilesWithoutPosesAndMissingFiles) {
  const TemporaryFolder folder;
  const std::string path = folder.add("a.txt", "").string();
  EXPECT_EQ(io_error_of([&] { read_trajectory(path); }), path + ": line 1: found no values, expected poses");
  EXPECT_THAT(io_error_of([] { read_trajectory("missing.txt"); }),
              StartsWith("missing.txt: no such file or directory"));
}

TEST(ReadTrajectory, TakesADirectoryOfMatricesInNaturalOrder) {
  const TemporaryFolder folder;
  for (const int i : {10, 9, 1}) folder.add("pose-" + std::to_string(i) + ".txt", translated(i));
  folder.add("notes.md", "hello");
  folder.add(".hidden.txt", "hello");
  for (const std::string suffix : {"", "/pose-*.txt"}) {
    const TrajectoryFile file = read_trajectory(folder.path().string() + suffix);
    EXPECT_EQ(file.format, kMatrices);
    ASSERT_EQ(file.trajectory.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(file.trajectory.world_from_scan[i].translation.x(), (std::array{1.0, 9.0, 10.0}[i]));
    }
  }
}

TEST(ReadTrajectory, NamesTheFileOfABadMatrix) {
  const TemporaryFolder folder;
  folder.add("1.txt", kIdentity);
  const std::string path = folder.add("2.txt", "1 0 0 0\n0 2 0 0\n0 0 1 0\n0 0 0 1\n").string();
  EXPECT_THAT(io_error_of([&] { read_trajectory(folder.path().string()); }),
              StartsWith(path + ": line 1: the 3×3 part is no rotation"));
  folder.add("2.txt", std::string(kIdentity) + kIdentity);
  EXPECT_EQ(io_error_of([&] { read_trajectory(folder.path().string()); }),
            path + ": line 5: found more than 16 values, expected one 4×4 matrix (or 3×4)");
  folder.add("2.txt", "1 0 0 0\n0 1 0 0\n");
  EXPECT_EQ(io_error_of([&] { read_trajectory(folder.path().string()); }),
            path + ": line 2: found 2 rows of 4 numbers in all, expected 4 for each matrix");
}

TEST(ReadTrajectory, RefusesFoldersForFormatsOfOneFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(io_error_of([&] { read_trajectory(folder.path().string()); }),
            folder.path().string() + ": the directory holds no .txt files, expected one matrix each");
  folder.add("1.txt", kIdentity);
  EXPECT_EQ(io_error_of([&] { read_trajectory(folder.path().string(), kTum); }),
            folder.path().string() + ": it stands for 1 files, expected one file of the format tum");
}

TEST(ReadTrajectory, WarnsOfRoundedMatricesAcrossFiles) {
  const TemporaryFolder folder;
  for (const char* name : {"1.txt", "2.txt"}) folder.add(name, "1 0 0 0.25\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const TrajectoryFile file = read_trajectory(folder.path().string());
  ASSERT_EQ(file.warnings.size(), 1U);
  EXPECT_EQ(file.warnings[0].code, "rounded_poses");
}

TEST(ReadTrajectory, ReadsTheRealTrajectories) {
  const auto data = real_data();
  if (!data) GTEST_SKIP() << "no real data: set TRYSQUARE_DATA";
  const auto expect = [&](const char* name, TrajectoryFormat format, std::size_t num_poses,
                          std::int64_t first_stamp_ns) {
    const TrajectoryFile file = read_trajectory((*data / name).string());
    EXPECT_EQ(file.format, format) << name;
    EXPECT_EQ(file.trajectory.size(), num_poses) << name;
    if (format == kTum || format == kEuroc) {
      ASSERT_EQ(file.trajectory.stamps_ns.size(), num_poses) << name;
      EXPECT_EQ(file.trajectory.stamps_ns[0], first_stamp_ns) << name;
    }
  };
  expect("trajectories/KITTI_00_gt.txt", kKitti, 4541, 0);
  expect("trajectories/KITTI_00_ORB.txt", kKitti, 4541, 0);
  expect("trajectories/V102.txt", kTum, 807, 1403715529112143517);
  expect("trajectories/V102_groundtruth.csv", kEuroc, 16702, 1403715524907143168);
  expect("trajectories/fr2_desk_ORB.txt", kTum, 2893, 1311868164363181000);
  expect("trajectories/fr2_desk_groundtruth.txt", kTum, 20957, 1311868163869700000);
  expect("kitti00/poses.txt", kKitti, 20, 0);
  expect("arcore-depth/poses", kMatrices, 28, 0);
}

}  // namespace
}  // namespace trysquare
