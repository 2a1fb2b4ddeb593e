// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/write_ply.h"

#include "trysquare/io/file.h"
#include "trysquare/io/internal/test_files.h"
#include "trysquare/io/read_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trysquare {
namespace {

using internal::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(WritePly, IsReadBack) {
  const TemporaryFolder folder;
  PointTable table;
  table.columns = {{"plane variance", {}}, {"scalar_scan", {}}};
  for (int i = 0; i < 50000; ++i) {  // more than one piece
    table.points.emplace_back(0.1 * i, 5e6 + i, -i / 3.0);
    table.columns[0].values.push_back(0.25 * i);
    table.columns[1].values.push_back(i % 7);
  }
  table.columns[0].values[3] = std::numeric_limits<double>::quiet_NaN();
  write_ply(folder.path() / "map.ply", table);
  const PointTable read = read_points(folder.path() / "map.ply");
  EXPECT_EQ(read.points, table.points);
  ASSERT_EQ(read.columns.size(), 2U);
  EXPECT_EQ(read.columns[0].name, "scalar_plane_variance");
  EXPECT_EQ(read.columns[1].name, "scalar_scan");
  EXPECT_EQ(read.columns[1].values, table.columns[1].values);
  EXPECT_TRUE(std::isnan(read.columns[0].values[3]));
  EXPECT_EQ(read.columns[0].values[49999], table.columns[0].values[49999]);
  EXPECT_THAT(folder.names(), ElementsAre("map.ply"));
}

TEST(WritePly, StoresCoordinatesAsDoubleAndColumnsAsFloat) {
  const TemporaryFolder folder;
  write_ply(folder.path() / "a.ply", {{{1, 2, 3}}, {{"entropy", {4}}}});
  const std::string bytes = read_file(folder.path() / "a.ply");
  EXPECT_THAT(bytes,
              HasSubstr("property double x\nproperty double y\nproperty double z\nproperty float scalar_entropy\n"));
  EXPECT_TRUE(bytes.ends_with(internal::bytes_of(3.0) + internal::bytes_of(4.0F)));
}

TEST(WritePly, StoresColorsAsBytesAfterTheCoordinates) {
  const TemporaryFolder folder;
  write_ply(folder.path() / "a.ply",
            {.points = {{1, 2, 3}}, .columns = {{"direction", {2}}}, .colors = {{{250, 7, 128}}}});
  const std::string bytes = read_file(folder.path() / "a.ply");
  EXPECT_THAT(bytes, HasSubstr("double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                               "property float scalar_direction\n"));
  EXPECT_TRUE(bytes.ends_with(internal::bytes_of(3.0) + "\xfa\x07\x80" + internal::bytes_of(2.0F)));
  const PointTable read = read_points(folder.path() / "a.ply");
  EXPECT_EQ(read.points[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(read.columns.back().values, (std::vector<double>{2}));
}

TEST(WritePly, WritesEmptyClouds) {
  const TemporaryFolder folder;
  write_ply(folder.path() / "a.ply", {});
  EXPECT_EQ(read_points(folder.path() / "a.ply").points.size(), 0U);
}

TEST(WritePly, RefusesColumnsOfAnotherLength) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_ply(folder.path() / "a.ply", {{{1, 2, 3}}, {{"entropy", {}}}}), InvalidArgument);
  const PointTable with_too_many_colors{.points = {{1, 2, 3}}, .columns = {}, .colors = {{}, {}}};
  EXPECT_THROW(write_ply(folder.path() / "a.ply", with_too_many_colors), InvalidArgument);
  EXPECT_THAT(folder.names(), testing::IsEmpty());
}

}  // namespace
}  // namespace trysquare
