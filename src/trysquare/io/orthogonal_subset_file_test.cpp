// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/orthogonal_subset_file.h"

#include "trysquare/io/internal/test_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using internal::io_error_of;
using internal::real_data;
using internal::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ReadPointGroups, GivesOneGroupForEachFileInOrder) {
  const TemporaryFolder folder;
  folder.add("d10.xyz", "1 0 0\n");
  folder.add("d2.xyz", "0 1 0\n0 2 0\n");
  const auto groups = read_point_groups((folder.path() / "d*.xyz").string());
  EXPECT_THAT(groups, ElementsAre(ElementsAre(Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 2, 0)),
                                  ElementsAre(Eigen::Vector3d(1, 0, 0))));
}

TEST(ReadPointGroups, RefusesPointsThatAreNotFinite) {
  const TemporaryFolder folder;
  const std::string path = folder.add("a.xyz", "1 0 0\n0 nan 0\n").string();
  EXPECT_EQ(io_error_of([&] { read_point_groups(path); }),
            path + ": point 1 is not finite, expected points of an orthogonal subset");
}

TEST(ReadPointGroups, ReadsTheSubsetOfTheDepthDataAndRefusesItsPickle) {
  const auto data = real_data();
  if (!data) GTEST_SKIP() << "no real data: set TRYSQUARE_DATA";
  const std::string folder = (*data / "arcore-depth/orth_subset").string();
  const auto groups = read_point_groups(folder + "/orth-0091-*.npy");
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_EQ(groups[0].size(), 39U);
  EXPECT_EQ(groups[1].size(), 66U);
  EXPECT_EQ(groups[2].size(), 188U);
  EXPECT_THAT(io_error_of([&] { read_point_groups(folder + "/orth-0091.npy"); }),
              HasSubstr("orth-0091.npy: byte 128: it is a pickled object array, which is never unpickled"));
}

}  // namespace
}  // namespace trysquare
