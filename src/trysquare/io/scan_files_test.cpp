// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/scan_files.h"

#include "trysquare/io/internal/find_files.h"
#include "trysquare/io/internal/test_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using internal::io_error_of;
using internal::natural_less;
using internal::real_data;
using internal::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names_of(const std::vector<std::filesystem::path>& paths) {
  std::vector<std::string> names;
  for (const auto& path : paths) names.push_back(path.filename().string());
  return names;
}

TEST(NaturalLess, CountsNumbersAsNumbers) {
  EXPECT_TRUE(natural_less("scan2", "scan10"));
  EXPECT_FALSE(natural_less("scan10", "scan2"));
  EXPECT_TRUE(natural_less("scan9b1", "scan9b2"));
  EXPECT_TRUE(natural_less("a", "a1"));
  EXPECT_TRUE(natural_less("scan99999999999999999999998", "scan99999999999999999999999"));
}

TEST(NaturalLess, IsAStrictOrder) {
  const std::vector<std::string> sorted = {"", "1", "01", "1a", "2", "10", "a", "a01b", "a1b", "a1c", "a2"};
  EXPECT_FALSE(natural_less("1", "1"));
  EXPECT_NE(natural_less("1", "01"), natural_less("01", "1"));
  for (const std::string& a : sorted) {
    for (const std::string& b : sorted) {
      EXPECT_TRUE(a == b || natural_less(a, b) != natural_less(b, a)) << a << " " << b;
      for (const std::string& c : sorted) {
        EXPECT_TRUE(!natural_less(a, b) || !natural_less(b, c) || natural_less(a, c)) << a << " " << b << " " << c;
      }
    }
  }
}

TEST(ExpandFiles, TakesTheScansOfADirectoryInNaturalOrder) {
  const TemporaryFolder folder;
  for (const char* name : {"s10.pcd", "s2.pcd", "S1.PCD", ".s0.pcd", "readme.md", "times.txt", "poses.csv"})
    folder.add(name, "");
  std::filesystem::create_directory(folder.path() / "s3.pcd");
  EXPECT_THAT(names_of(expand_files(folder.path().string())), ElementsAre("S1.PCD", "s2.pcd", "s10.pcd"));
}

TEST(ExpandFiles, TakesTextFilesWhereThereAreNoOthers) {
  const TemporaryFolder folder;
  folder.add("2.txt", "");
  folder.add("1.txt", "");
  EXPECT_THAT(names_of(expand_files(folder.path().string())), ElementsAre("1.txt", "2.txt"));
}

TEST(ExpandFiles, RefusesSeveralKindsInOneDirectory) {
  const TemporaryFolder folder;
  folder.add("a.ply", "");
  folder.add("a.pcd", "");
  const std::string path = folder.path().string();
  EXPECT_EQ(io_error_of([&] { expand_files(path); }),
            path + ": the directory holds point files of several kinds (.pcd .ply); name one by a pattern such as \"" +
                path + "/*.pcd\"");
}

TEST(ExpandFiles, TellsKittiFromNuScenes) {
  const TemporaryFolder folder;
  folder.add("a.pcd.bin", "");
  folder.add("a.bin", "");
  EXPECT_THAT(io_error_of([&] { expand_files(folder.path().string()); }), HasSubstr("several kinds (.bin .pcd.bin)"));
}

TEST(ExpandFiles, UnderstandsPatterns) {
  const TemporaryFolder folder;
  for (const char* name : {"s1.ply", "s2.ply", "s10.ply", "t1.ply", "s1.txt"}) folder.add(name, "");
  const std::string path = folder.path().string();
  EXPECT_THAT(names_of(expand_files(path + "/s*.ply")), ElementsAre("s1.ply", "s2.ply", "s10.ply"));
  EXPECT_THAT(names_of(expand_files(path + "/?[2-9].ply")), ElementsAre("s2.ply"));
}

TEST(ExpandFiles, KeepsTheOrderOfLists) {
  const TemporaryFolder folder;
  for (const char* name : {"a.ply", "b1.ply", "b2.ply", "c,d.ply"}) folder.add(name, "");
  const std::string path = folder.path().string();
  EXPECT_THAT(names_of(expand_files(path + "/b*.ply, " + path + "/a.ply")), ElementsAre("b1.ply", "b2.ply", "a.ply"));
  EXPECT_THAT(names_of(expand_files(path + "/c,d.ply")), ElementsAre("c,d.ply"));
  EXPECT_EQ(io_error_of([&] { expand_files(path + "/a.ply," + path + "/x.ply"); }),
            path + "/x.ply: no such file or directory, and no file matches it as a pattern");
}

TEST(ExpandFiles, SaysWhenNothingMatches) {
  const TemporaryFolder folder;
  folder.add("notes.md", "");
  const std::string path = folder.path().string();
  EXPECT_EQ(io_error_of([&] { expand_files(path); }), path + ": the directory holds no point files (1 other files)");
  EXPECT_EQ(io_error_of([&] { expand_files(path + "/*.ply"); }),
            path + "/*.ply: no such file or directory, and no file matches it as a pattern");
  EXPECT_NE(io_error_of([] { expand_files(""); }), "");
  EXPECT_NE(io_error_of([] { expand_files(","); }), "");
}

TEST(ScanFiles, LoadsByIndexAndPassesTimeStampsOn) {
  const TemporaryFolder folder;
  const ScanFiles scans({folder.add("a.xyz", "1 2 3\n"), folder.add("b.xyz", "4 5 6\n")}, {10, 20});
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_THAT(scans.load(1).points_in_scan, ElementsAre(Eigen::Vector3d(4, 5, 6)));
  EXPECT_EQ(scans.load(1).stamp_ns, 20);
  EXPECT_EQ(scans.name(0), (folder.path() / "a.xyz").string());
}

TEST(ScanFiles, RefusesAnotherNumberOfTimeStamps) {
  EXPECT_THROW(ScanFiles({"a.xyz", "b.xyz"}, {10}), InvalidArgument);
}

TEST(OpenScans, KnowsTheRootOfAKittiSequence) {
  const TemporaryFolder folder;
  folder.add("velodyne/000001.bin", "");
  folder.add("velodyne/000002.bin", "");
  folder.add("times.txt", "0.0\n1.037359e-01\n2.073381e-01\n");
  for (const std::string suffix : {"", "/", "/velodyne", "/velodyne/"}) {
    const ScanFiles scans = open_scans(folder.path().string() + suffix);
    EXPECT_THAT(names_of(scans.paths()), ElementsAre("000001.bin", "000002.bin")) << suffix;
    EXPECT_THAT(scans.stamps_ns(), ElementsAre(103735900, 207338100)) << suffix;
  }
}

TEST(OpenScans, RefusesTimesThatDoNotFit) {
  const TemporaryFolder folder;
  folder.add("velodyne/a.bin", "");
  folder.add("velodyne/b.bin", "");
  const std::string times = folder.add("times.txt", "0.0\n").string();
  EXPECT_THAT(io_error_of([&] { open_scans(folder.path().string()); }),
              HasSubstr(times + ": found 1 times, expected one for each of 2 scans"));
  folder.add("times.txt", "0.0\nnoon\n");
  EXPECT_EQ(io_error_of([&] { open_scans(folder.path().string()); }),
            times + ": line 2: found \"noon\", expected a time in seconds");
  folder.add("times.txt", "0.5\n1.5\n");
  EXPECT_THAT(open_scans(folder.path().string()).stamps_ns(), ElementsAre(500000000, 1500000000));
}

TEST(OpenScans, ReadsTimesFromNames) {
  const TemporaryFolder folder;
  folder.add("1403715524907143168.pcd", "");
  folder.add("1403715524957143040.pcd", "");
  EXPECT_THAT(open_scans(folder.path().string()).stamps_ns(), ElementsAre(1403715524907143168, 1403715524957143040));
  folder.add("seconds/1311868164.363181.ply", "");
  EXPECT_THAT(open_scans((folder.path() / "seconds/*.ply").string()).stamps_ns(), ElementsAre(1311868164363181000));
  folder.add("000001.pcd", "");
  EXPECT_TRUE(open_scans(folder.path().string()).stamps_ns().empty());
}

TEST(OpenScans, OpensTheRealSequences) {
  const auto data = real_data();
  if (!data) GTEST_SKIP() << "no real data: set TRYSQUARE_DATA";
  const ScanFiles kitti = open_scans((*data / "kitti00").string());
  EXPECT_EQ(kitti.size(), 20U);
  EXPECT_EQ(kitti.stamps_ns().at(1), 103735900);
  EXPECT_EQ(open_scans((*data / "arcore-depth/pcs").string()).size(), 28U);
}

}  // namespace
}  // namespace trysquare
