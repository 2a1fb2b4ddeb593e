// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_xyz.h"

#include "trysquare/io/internal/test_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace trysquare {
namespace {

using internal::io_error_of;
using testing::ElementsAre;

PointTable parse(const std::string& text) { return parse_xyz(text, "a.xyz", Columns::kAll); }

std::string error_of(const std::string& text) {
  return io_error_of([&] { parse(text); });
}

const std::vector<Eigen::Vector3d> kTwoPoints = {{1, 2, 3}, {4, 5, 6}};

TEST(ParseXyz, PartsNumbersAtSpacesCommasAndSemicolons) {
  for (const char* text : {"1 2 3\n4 5 6\n", "1,2,3\n4,5,6", "1;2;3;\r\n4;5;6;\r\n", "\t1,  2 3\n\n  4\t5,6\n"}) {
    EXPECT_EQ(parse(text).points, kTwoPoints) << text;
  }
}

TEST(ParseXyz, SkipsCommentsAndByteOrderMarks) {
  EXPECT_EQ(parse("\xEF\xBB\xBF# a cloud\n// of two\n1 2 3 # first\n4 5 6 // second\n").points, kTwoPoints);
}

TEST(ParseXyz, FindsColumnsByTheirNames) {
  for (const char* text : {"time,x,Y,z\n9,1,2,3\n8,4,5,6\n", "\"time [s]\";\"x\";\"y\";\"z\"\n9;1;2;3\n8;4;5;6\n",
                           "time, x [m], y [m], z [m]\n9, 1, 2, 3\n8, 4, 5, 6\n", "//time X Y Z\n9 1 2 3\n8 4 5 6\n",
                           "# made by hand\n# time x y z\n9 1 2 3\n8 4 5 6\n"}) {
    const PointTable table = parse(text);
    EXPECT_EQ(table.points, kTwoPoints) << text;
    ASSERT_EQ(table.columns.size(), 1U) << text;
    EXPECT_THAT(table.columns[0].values, ElementsAre(9, 8)) << text;
  }
}

TEST(ParseXyz, NumbersColumnsWithoutNames) {
  const PointTable table = parse("# four columns\n1 2 3 9\n4 5 6 8\n");
  EXPECT_EQ(table.points, kTwoPoints);
  ASSERT_EQ(table.columns.size(), 1U);
  EXPECT_EQ(table.columns[0].name, "column_4");
}

TEST(ParseXyz, TakesALeadingNumberOfPoints) {
  EXPECT_EQ(parse("2\n1 2 3\n4 5 6\n").points, kTwoPoints);
  EXPECT_EQ(error_of("3\n1 2 3\n4 5 6\n"),
            "a.xyz: byte 14: the file ends after 2 points, expected 3 as its first line says");
  EXPECT_EQ(parse("0\n").points.size(), 0U);
}

TEST(ParseXyz, KeepsPointsThatAreNotFinite) {
  const PointTable table = parse("nan inf 3\n4 5 6\n");
  ASSERT_EQ(table.points.size(), 2U);
  EXPECT_TRUE(std::isnan(table.points[0].x()));
}

TEST(ParseXyz, AHeaderAloneIsAnEmptyCloud) { EXPECT_EQ(parse("x,y,z\n").points.size(), 0U); }

TEST(ParseXyz, RefusesFilesWithoutPoints) {
  EXPECT_EQ(error_of(""), "a.xyz: byte 0: the file is empty, expected points");
  EXPECT_EQ(error_of("# nothing\n\n"), "a.xyz: byte 11: found no points");
}

TEST(ParseXyz, NamesTheLineOfWhatIsNoPoint) {
  EXPECT_EQ(error_of("1 2 3\n4 five 6\n"), "a.xyz: line 2: value 2 is \"five\", expected a number");
  EXPECT_EQ(error_of("1 2 3\n4 5\n"), "a.xyz: line 2: found 2 values, expected 3");
  EXPECT_EQ(error_of("1 2 3\n4 5 6 7\n"), "a.xyz: line 2: found 4 values, expected 3");
  EXPECT_EQ(error_of("1,2,3\n4,,6\n"), "a.xyz: line 2: value 2 is \"\", expected a number");
  EXPECT_EQ(error_of("1 2\n"), "a.xyz: line 1: found 2 values, expected x y z");
  EXPECT_EQ(error_of("easting,y,z\n"), "a.xyz: line 1: no field x, expected x, y and z; found \"easting\" \"y\" \"z\"");
  EXPECT_EQ(error_of("x,y,z,x\n"), "a.xyz: line 1: there are two fields x, expected one");
}

TEST(ParseXyz, RefusesDecimalCommas) {
  EXPECT_EQ(error_of("1,5;2,5;3,5\n"), "a.xyz: line 1: found commas and semicolons; decimal commas are not understood");
}

TEST(ParseXyz, RefusesBinaryFiles) { EXPECT_NE(error_of(std::string("\x01\x02\0\n\xFF", 5)), ""); }

}  // namespace
}  // namespace trysquare
