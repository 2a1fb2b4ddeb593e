// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_points.h"

#include "trysquare/io/internal/test_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using internal::io_error_of;
using internal::real_data;
using internal::TemporaryFolder;
using testing::ElementsAre;

TEST(PointFormatOf, LooksAtTheEndOfTheName) {
  EXPECT_EQ(point_format_of("a/000000.bin"), PointFormat::kKittiBin);
  EXPECT_EQ(point_format_of("a/sweep.pcd.bin"), PointFormat::kNuScenesBin);
  EXPECT_EQ(point_format_of("a/SCAN.PCD"), PointFormat::kPcd);
  EXPECT_EQ(point_format_of("a.ply"), PointFormat::kPly);
  EXPECT_EQ(point_format_of("a.npy"), PointFormat::kNpy);
  for (const char* name : {"a.xyz", "a.txt", "a.csv", "a.asc", "a.pts"})
    EXPECT_EQ(point_format_of(name), PointFormat::kXyz);
}

TEST(PointFormatOf, NamesTheFormatsItKnows) {
  EXPECT_EQ(
      io_error_of([] { point_format_of("map.las"); }),
      "map.las: the ending of the name is not that of a point format, expected one of .pcd.bin .bin .pcd .ply .npy "
      ".xyz .txt .csv .asc .pts");
}

TEST(ReadScan, DropsAndCountsPointsWithoutAMeasurement) {
  const TemporaryFolder folder;
  const auto path = folder.add("a.xyz", "1 2 3\n0 0 0\nnan 0 0\n-0 0 0\n0 0 inf\n0 0 1e-300\n1 1 -1e999\n");
  const Scan scan = read_scan(path);
  EXPECT_THAT(scan.points_in_scan, ElementsAre(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(0, 0, 1e-300)));
  EXPECT_EQ(scan.num_not_finite, 3U);
  EXPECT_EQ(scan.num_at_origin, 2U);
}

TEST(ReadMap, KeepsAndCountsPointsAtTheOrigin) {
  const TemporaryFolder folder;
  const Scan map = read_map(folder.add("a.xyz", "1 2 3\n0 0 0\nnan 0 0\n"));
  EXPECT_THAT(map.points_in_scan, ElementsAre(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(0, 0, 0)));
  EXPECT_EQ(map.num_not_finite, 1U);
  EXPECT_EQ(map.num_at_origin, 1U);
}

TEST(ReadScan, NamesThePathInEveryError) {
  const TemporaryFolder folder;
  const std::string path = folder.add("a.bin", "x").string();
  EXPECT_THAT(io_error_of([&] { read_scan(path); }), testing::StartsWith(path + ": byte 1: "));
}

TEST(ReadScan, ReadsKittiAndArcoreClouds) {
  const auto data = real_data();
  if (!data) GTEST_SKIP() << "no real data: set TRYSQUARE_DATA";
  EXPECT_EQ(read_scan(*data / "kitti00/velodyne/000000.bin").points_in_scan.size(), 124668U);
  EXPECT_EQ(read_scan(*data / "arcore-depth/pcs/PC-0071.pcd").points_in_scan.size(), 2859U);
}

}  // namespace
}  // namespace trysquare
