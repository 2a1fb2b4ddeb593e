// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_pcd.h"

#include "trysquare/io/internal/test_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace trysquare {
namespace {

using internal::bytes_of;
using internal::bytes_of_all;
using internal::io_error_of;
using testing::ElementsAre;
using testing::StartsWith;

constexpr const char* kXyzHeader =
    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
    "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";

/// The header with one of its lines put in the place of another.
std::string with_line(const std::string& line, const std::string& data = "DATA ascii\n1 2 3\n4 5 6\n") {
  const std::string key = line.substr(0, line.find(' ') + 1);
  std::string header = kXyzHeader;
  const std::size_t begin = header.find("\n" + key) + 1;
  header.replace(begin, header.find('\n', begin) - begin, line);
  return header + data;
}

PointTable parse(const std::string& bytes, Columns columns = Columns::kAll) {
  return parse_pcd(bytes, "a.pcd", columns);
}

std::string error_of(const std::string& bytes) {
  return io_error_of([&] { parse(bytes); });
}

const std::vector<Eigen::Vector3d> kTwoPoints = {{1, 2, 3}, {4, 5, 6}};

TEST(ParsePcd, ReadsAscii) {
  EXPECT_EQ(parse(kXyzHeader + std::string("DATA ascii\n1 2 3\n4 5 6\n")).points, kTwoPoints);
}

TEST(ParsePcd, ReadsAsciiWithCrlfAndWithoutALastLineEnd) {
  std::string text = kXyzHeader + std::string("DATA ascii\n1 2 3\n4 5 6");
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  EXPECT_EQ(parse(text).points, kTwoPoints);
}

TEST(ParsePcd, ReadsBinaryBehindCrlf) {
  EXPECT_EQ(parse(kXyzHeader + std::string("DATA binary\r\n") + bytes_of_all<float>({1, 2, 3, 4, 5, 6})).points,
            kTwoPoints);
}

TEST(ParsePcd, ReadsEveryTypeCountAndPadding) {
  const std::string header =
      "VERSION .7\nFIELDS a x _ y d z e f g h i j\nSIZE 1 8 1 8 4 8 1 2 2 4 8 8\nTYPE I F U F F F U I U I I U\n"
      "COUNT 1 1 3 1 2 1 1 1 1 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary\n";
  const std::string body = bytes_of(std::int8_t{-7}) + bytes_of(0.1) + "pad" + bytes_of(0.2) + bytes_of(8.5F) +
                           bytes_of(9.5F) + bytes_of(0.3) + bytes_of(std::uint8_t{200}) + bytes_of(std::int16_t{-300}) +
                           bytes_of(std::uint16_t{60000}) + bytes_of(std::int32_t{-70000}) +
                           bytes_of(std::int64_t{-5000000000}) + bytes_of(std::uint64_t{9000000000});
  const PointTable table = parse(header + body);
  EXPECT_THAT(table.points, ElementsAre(Eigen::Vector3d(0.1, 0.2, 0.3)));
  std::vector<std::string> names;
  std::vector<double> values;
  for (const PointTable::Column& column : table.columns) {
    names.push_back(column.name);
    values.push_back(column.values.at(0));
  }
  EXPECT_THAT(names, ElementsAre("a", "d_0", "d_1", "e", "f", "g", "h", "i", "j"));
  EXPECT_THAT(values, ElementsAre(-7, 8.5, 9.5, 200, -300, 60000, -70000, -5e9, 9e9));
}

TEST(ParsePcd, AsciiColumnsStayWithTheirPoints) {
  const PointTable table = parse(
      "FIELDS rgb x y z\nSIZE 4 4 4 4\nTYPE U F F F\nWIDTH 2\nHEIGHT 1\nDATA ascii\n4278190080 1 2 3\n7 nan -inf 6\n");
  EXPECT_EQ(table.points[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(std::isnan(table.points[1].x()));
  EXPECT_TRUE(std::isinf(table.points[1].y()));
  EXPECT_THAT(table.columns.at(0).values, ElementsAre(4278190080, 7));
}

TEST(ParsePcd, ReadsCompressedFieldAfterField) {
  const std::string planes = bytes_of_all<float>({1, 4, 2, 5, 3, 6});
  const std::string body = internal::compressed_body(internal::lzf_literals(planes), planes.size());
  EXPECT_EQ(parse(kXyzHeader + std::string("DATA binary_compressed\n") + body).points, kTwoPoints);
}

/// A back reference by hand: three literal zeros, then 21 more bytes from one byte back (length 7 + 12 + 2).
TEST(ParsePcd, UnpacksBackReferences) {
  std::string packed("\x02\0\0\0", 4);
  packed += std::string("\xE0\x0C\x00", 3);
  EXPECT_THAT(
      parse(kXyzHeader + std::string("DATA binary_compressed\n") + internal::compressed_body(packed, 24)).points,
      ElementsAre(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()));
}

TEST(ParsePcd, CompressedPaddingMayBeStoredOrNot) {
  const std::string header =
      "FIELDS x _ y z\nSIZE 4 1 4 4\nTYPE F U F F\nCOUNT 1 4 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA "
      "binary_compressed\n";
  const std::string xs = bytes_of_all<float>({1, 4});
  const std::string rest = bytes_of_all<float>({2, 5, 3, 6});
  for (const std::string& padding : {std::string(), std::string("12345678")}) {
    const std::string planes = xs + padding + rest;
    EXPECT_EQ(parse(header + internal::compressed_body(internal::lzf_literals(planes), planes.size())).points,
              kTwoPoints);
  }
}

TEST(ParsePcd, ZeroPointsAreAnEmptyCloud) {
  std::string header = kXyzHeader;
  header.replace(header.find("WIDTH 2"), 7, "WIDTH 0");
  header.replace(header.find("POINTS 2"), 8, "POINTS 0");
  for (const std::string& data :
       {std::string("ascii\n"), std::string("binary\n"), "binary_compressed\n" + internal::compressed_body("", 0)}) {
    EXPECT_TRUE(parse(header + "DATA " + data).points.empty());
    EXPECT_EQ(error_of(header + "DATA " + data), "");
  }
}

TEST(ParsePcd, RefusesAnEmptyFile) {
  EXPECT_EQ(error_of(""), "a.pcd: byte 0: the file is empty, expected a PCD header");
}

TEST(ParsePcd, RefusesOtherFiles) {
  EXPECT_THAT(error_of("ply\n"), StartsWith("a.pcd: line 1: found \"ply\", expected a PCD header entry"));
  EXPECT_EQ(error_of(std::string("VERSION 0.7\nFIE\0LDS\n", 20)),
            "a.pcd: byte 15: found a NUL byte, expected the text of a PCD header");
  EXPECT_EQ(error_of("VERSION 0.7\n"), "a.pcd: byte 12: the file ends within the header, expected a DATA line");
}

TEST(ParsePcd, SaysHowManyBytesAreThereAndNeeded) {
  EXPECT_EQ(error_of(kXyzHeader + std::string("DATA binary\n") + std::string(20, 'x')),
            "a.pcd: byte 164: the file ends early: 20 bytes from here, expected 2 points of 12 bytes");
  EXPECT_EQ(error_of(kXyzHeader + std::string("DATA ascii\n1 2 3\n")),
            "a.pcd: byte 163: the file ends early: 6 bytes from here, expected 2 lines of 3 values");
  EXPECT_EQ(error_of(kXyzHeader + std::string("DATA ascii\n1.00000 2 3\n")),
            "a.pcd: byte 175: the file ends after 1 points, expected 2");
  const std::string packed = internal::lzf_literals(std::string(24, 'x'));
  EXPECT_EQ(error_of(kXyzHeader + std::string("DATA binary_compressed\n") +
                     internal::compressed_body(packed, 24).substr(0, 20)),
            "a.pcd: byte 175: the compressed points end early: 12 bytes, expected 25");
  EXPECT_EQ(error_of(kXyzHeader + std::string("DATA binary_compressed\n") + "1234"),
            "a.pcd: byte 175: found 4 bytes, expected 8 for the compressed and uncompressed size");
}

TEST(ParsePcd, RefusesMoreBytesThanPoints) {
  EXPECT_EQ(error_of(kXyzHeader + std::string("DATA binary\n") + std::string(36, 'x')),
            "a.pcd: byte 188: found 12 more bytes, expected the end of the file after 2 points of 12 bytes");
  EXPECT_EQ(error_of(kXyzHeader + std::string("DATA ascii\n1 2 3\n4 5 6\n7 8 9\n")),
            "a.pcd: line 14: found another line, expected 2 points");
}

TEST(ParsePcd, RefusesClaimsThatTheBytesCannotHold) {
  for (const char* data : {"DATA ascii\n", "DATA binary\n"}) {
    std::string text = with_line("POINTS 1000000000000", data);
    text.replace(text.find("WIDTH 2"), 7, "WIDTH 1000000000000");
    EXPECT_THAT(error_of(text), testing::HasSubstr("the file ends early: 0 bytes from here, expected 1000000000000"));
  }
  std::string compressed =
      with_line("POINTS 1000000000000", "DATA binary_compressed\n" + internal::compressed_body("", 24));
  compressed.replace(compressed.find("WIDTH 2"), 7, "WIDTH 1000000000000");
  EXPECT_THAT(error_of(compressed),
              testing::HasSubstr("the uncompressed size is 24, expected 1000000000000 points of 12 bytes"));
}

TEST(ParsePcd, RefusesMoreThanLzfCanStandFor) {
  std::string text =
      with_line("POINTS 100000000", "DATA binary_compressed\n" + internal::compressed_body("123", 1200000000));
  text.replace(text.find("WIDTH 2"), 7, "WIDTH 100000000");
  EXPECT_THAT(error_of(text),
              testing::HasSubstr("the uncompressed size is 1200000000, more than 3 bytes of LZF can stand for"));
}

TEST(ParsePcd, RefusesDamagedCompression) {
  const std::string packed = std::string("\x20\xFF", 2) + std::string(22, '\0');  // refers to bytes before the first
  EXPECT_THAT(error_of(kXyzHeader + std::string("DATA binary_compressed\n") + internal::compressed_body(packed, 24)),
              testing::HasSubstr("byte 183: the compressed points are damaged: LZF gives 0 bytes, expected 24"));
}

TEST(ParsePcd, RefusesSizesThatOverflow) {
  std::string text = with_line("WIDTH 9000000000000000000");
  text.replace(text.find("HEIGHT 1"), 8, "HEIGHT 9000000000000000000");
  EXPECT_EQ(error_of(text), "a.pcd: line 7: WIDTH 9000000000000000000 times HEIGHT 9000000000000000000 overflows");
  EXPECT_THAT(error_of(with_line("WIDTH 99999999999999999999")),
              StartsWith("a.pcd: line 7: WIDTH is \"99999999999999999999\""));
}

TEST(ParsePcd, RefusesHeadersThatContradictThemselves) {
  EXPECT_EQ(error_of("HEIGHT 1\n" + with_line("WIDTH 2")), "a.pcd: line 9: HEIGHT is there twice");
  EXPECT_EQ(error_of(with_line("POINTS 3")), "a.pcd: line 10: POINTS is 3, expected WIDTH times HEIGHT = 2");
  EXPECT_EQ(error_of(with_line("POINTS -2")),
            "a.pcd: line 10: POINTS is \"-2\", expected one whole number that is not negative");
  EXPECT_EQ(error_of(with_line("WIDTH two")),
            "a.pcd: line 7: WIDTH is \"two\", expected one whole number that is not negative");
  EXPECT_EQ(error_of(with_line("SIZE 4 4")), "a.pcd: line 4: SIZE has 2 values, expected 3, one for each of FIELDS");
  EXPECT_EQ(error_of(with_line("TYPE F F F F")),
            "a.pcd: line 5: TYPE has 4 values, expected 3, one for each of FIELDS");
  EXPECT_EQ(error_of(with_line("COUNT 1")), "a.pcd: line 6: COUNT has 1 values, expected 3, one for each of FIELDS");
}

TEST(ParsePcd, RefusesUnknownTypesAndSizes) {
  const char* expected = ", expected F of 4 or 8 bytes, I or U of 1, 2, 4 or 8";
  EXPECT_EQ(error_of(with_line("SIZE 4 3 4")),
            std::string("a.pcd: line 5: field \"y\" has TYPE \"F\" and SIZE \"3\"") + expected);
  EXPECT_EQ(error_of(with_line("SIZE 4 4 -4")),
            std::string("a.pcd: line 5: field \"z\" has TYPE \"F\" and SIZE \"-4\"") + expected);
  EXPECT_EQ(error_of(with_line("TYPE Q F F")),
            std::string("a.pcd: line 5: field \"x\" has TYPE \"Q\" and SIZE \"4\"") + expected);
}

TEST(ParsePcd, RefusesCountsThatAreNone) {
  for (const std::string count : {"0", "-1", "99999999999", "8193", "x"}) {
    EXPECT_EQ(error_of(with_line("COUNT " + count + " 1 1")),
              "a.pcd: line 6: field \"x\" has COUNT \"" + count +
                  "\", expected 1 or more, at most 8192 for all fields together");
  }
}

TEST(ParsePcd, RefusesMissingAndDoubleCoordinates) {
  EXPECT_EQ(error_of(with_line("FIELDS x y q")),
            "a.pcd: line 3: no field z, expected x, y and z; found \"x\" \"y\" \"q\"");
  EXPECT_EQ(error_of(with_line("FIELDS x y x")), "a.pcd: line 3: there are two fields x, expected one");
}

TEST(ParsePcd, RefusesUnknownData) {
  EXPECT_EQ(error_of(kXyzHeader + std::string("DATA zip\n")),
            "a.pcd: line 11: DATA is \"zip\", expected ascii, binary or binary_compressed");
}

TEST(ParsePcd, RefusesTextAndTooFewNumbers) {
  EXPECT_EQ(error_of(kXyzHeader + std::string("DATA ascii\n1 2 3\n4 five 6\n")),
            "a.pcd: line 13: value 2 is \"five\", expected a number");
  EXPECT_EQ(error_of(kXyzHeader + std::string("DATA ascii\n1 2 3\n4.00 5\n")),
            "a.pcd: line 13: found 2 values, expected 3");
}

}  // namespace
}  // namespace trysquare
