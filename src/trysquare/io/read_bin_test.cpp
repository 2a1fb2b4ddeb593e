// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_bin.h"

#include "trysquare/io/file.h"
#include "trysquare/io/internal/test_files.h"
#include "trysquare/io/write_bin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using internal::bytes_of_all;
using internal::io_error_of;
using testing::ElementsAre;

TEST(ParseKittiBin, GivesFloatsExactly) {
  const PointTable table =
      parse_kitti_bin(bytes_of_all<float>({0.1, -2, 3e7, 0.5, 4, 5, 6, 0.25}), "a.bin", Columns::kAll);
  const double tenth = static_cast<double>(0.1F);
  EXPECT_THAT(table.points, ElementsAre(Eigen::Vector3d(tenth, -2, 3e7), Eigen::Vector3d(4, 5, 6)));
  ASSERT_EQ(table.columns.size(), 1U);
  EXPECT_EQ(table.columns[0].name, "intensity");
  EXPECT_THAT(table.columns[0].values, ElementsAre(0.5, 0.25));
}

TEST(ParseKittiBin, LeavesColumnsOutOnDemand) {
  EXPECT_TRUE(parse_kitti_bin(bytes_of_all<float>({1, 2, 3, 4}), "a.bin", Columns::kNone).columns.empty());
}

TEST(ParseNuScenesBin, HasAFifthValue) {
  const PointTable table =
      parse_nuscenes_bin(bytes_of_all<float>({1, 2, 3, 40, 5, 6, 7, 8, 90, 10}), "a.pcd.bin", Columns::kAll);
  EXPECT_THAT(table.points, ElementsAre(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(6, 7, 8)));
  ASSERT_EQ(table.columns.size(), 2U);
  EXPECT_EQ(table.columns[1].name, "ring");
  EXPECT_THAT(table.columns[1].values, ElementsAre(5, 10));
}

TEST(ParseKittiBin, RefusesAnEmptyFile) {
  EXPECT_EQ(io_error_of([] { parse_kitti_bin("", "a.bin", Columns::kNone); }),
            "a.bin: byte 0: the file is empty, expected points of 16 bytes");
}

TEST(ParseKittiBin, RefusesHalfAPoint) {
  EXPECT_EQ(io_error_of([] { parse_kitti_bin(std::string(40, 'x'), "a.bin", Columns::kNone); }),
            "a.bin: byte 40: the file ends within a point: 40 bytes, expected a multiple of 16");
}

TEST(WriteKittiBin, IsReadBack) {
  const internal::TemporaryFolder folder;
  const std::vector<Eigen::Vector3d> points = {{1, 2, 3}, {-0.5, 0.25, 1e6}};
  write_kitti_bin(folder.path() / "a.bin", points);
  EXPECT_EQ(parse_kitti_bin(read_file(folder.path() / "a.bin"), "a.bin", Columns::kNone).points, points);
}

}  // namespace
}  // namespace trysquare
