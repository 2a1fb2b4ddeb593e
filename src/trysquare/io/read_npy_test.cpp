// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_npy.h"

#include "trysquare/io/internal/test_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using internal::bytes_of_all;
using internal::io_error_of;
using internal::npy_header;
using testing::ElementsAre;
using testing::HasSubstr;

PointTable parse(const std::string& bytes) { return parse_npy(bytes, "a.npy", Columns::kAll); }

std::string error_of(const std::string& bytes) {
  return io_error_of([&] { parse(bytes); });
}

const std::vector<Eigen::Vector3d> kTwoPoints = {{1, 2, 3}, {4, 5, 6}};
const std::vector<double> kRowByRow = {1, 2, 3, 4, 5, 6};
const std::vector<double> kColumnByColumn = {1, 4, 2, 5, 3, 6};

TEST(ParseNpy, ReadsEveryVersion) {
  for (const int version : {1, 2, 3}) {
    EXPECT_EQ(parse(npy_header("'<f8'", "(2, 3)", false, version) + bytes_of_all<double>(kRowByRow)).points,
              kTwoPoints);
  }
}

TEST(ParseNpy, ReadsEveryTypeOrderAndLayout) {
  for (const bool fortran : {false, true}) {
    const std::vector<double>& values = fortran ? kColumnByColumn : kRowByRow;
    const auto points_of = [&](const char* descr, const std::string& body) {
      return parse(npy_header(descr, "(2, 3)", fortran) + body).points;
    };
    EXPECT_EQ(points_of("'<f8'", bytes_of_all<double>(values)), kTwoPoints);
    EXPECT_EQ(points_of("'>f8'", bytes_of_all<double>(values, std::endian::big)), kTwoPoints);
    EXPECT_EQ(points_of("'<f4'", bytes_of_all<float>(values)), kTwoPoints);
    EXPECT_EQ(points_of("\">f4\"", bytes_of_all<float>(values, std::endian::big)), kTwoPoints);
  }
}

TEST(ParseNpy, NumbersFurtherColumns) {
  const PointTable table = parse(npy_header("'<f8'", "(2L, 4L)") + bytes_of_all<double>({1, 2, 3, 9, 4, 5, 6, 8}));
  EXPECT_EQ(table.points, kTwoPoints);
  ASSERT_EQ(table.columns.size(), 1U);
  EXPECT_EQ(table.columns[0].name, "column_4");
  EXPECT_THAT(table.columns[0].values, ElementsAre(9, 8));
}

TEST(ParseNpy, ZeroRowsAreAnEmptyCloud) { EXPECT_EQ(parse(npy_header("'<f8'", "(0, 3)")).points.size(), 0U); }

TEST(ParseNpy, NeverUnpicklesObjects) {
  EXPECT_EQ(
      error_of(npy_header("'|O'", "(3,)") + "\x80\x03"),
      "a.npy: byte 128: it is a pickled object array, which is never unpickled (a pickle can run any code); expected "
      "a plain array of shape (N, 3): save one file for each direction, numpy.save(\"direction-0.npy\", array[0])");
}

TEST(ParseNpy, RefusesWhatHoldsNoFloats) {
  EXPECT_THAT(error_of(npy_header("'<i4'", "(2, 3)")),
              HasSubstr("byte 128: the array holds \"<i4\", expected float32 or"));
  EXPECT_THAT(error_of(npy_header("'|f8'", "(2, 3)")), HasSubstr("the array holds \"|f8\""));
  EXPECT_THAT(error_of(npy_header("[('x', '<f8')]", "(2, 3)")), HasSubstr("byte 20: it is a structured array"));
}

TEST(ParseNpy, RefusesOtherShapes) {
  EXPECT_THAT(error_of(npy_header("'<f8'", "(6,)")), HasSubstr("the array has the shape (6), expected (N, 3)"));
  EXPECT_THAT(error_of(npy_header("'<f8'", "(3, 2)")), HasSubstr("the array has the shape (3, 2), expected (N, 3)"));
  EXPECT_THAT(error_of(npy_header("'<f8'", "(1, 2, 3)")), HasSubstr("the array has the shape (1, 2, 3)"));
  EXPECT_THAT(error_of(npy_header("'<f8'", "(0, 99999999999)")), HasSubstr("the array has the shape (0, 99999999999)"));
  EXPECT_THAT(error_of(npy_header("'<f8'", "(-1, 3)")), HasSubstr("expected the size of a dimension"));
  EXPECT_THAT(error_of(npy_header("'<f8'", "(99999999999999999999, 3)")),
              HasSubstr("expected the size of a dimension"));
}

TEST(ParseNpy, SaysHowManyBytesAreThereAndNeeded) {
  EXPECT_EQ(error_of(npy_header("'<f8'", "(2, 3)") + std::string(47, 'x')),
            "a.npy: byte 128: the file ends early: 47 bytes from here, expected 2 points of 24 bytes");
  EXPECT_EQ(error_of(npy_header("'<f8'", "(1000000000000, 3)")),
            "a.npy: byte 128: the file ends early: 0 bytes from here, expected 1000000000000 points of 24 bytes");
  EXPECT_EQ(error_of(npy_header("'<f8'", "(2, 3)") + std::string(49, 'x')),
            "a.npy: byte 176: found 1 more bytes, expected the end of the array");
}

TEST(ParseNpy, RefusesBrokenHeaders) {
  EXPECT_EQ(error_of(""), "a.npy: byte 0: the file is empty, expected an NPY header");
  EXPECT_EQ(error_of("PK\x03\x04zip"), "a.npy: byte 0: found \"PK\\x03\\x04zi\", expected \\x93NUMPY");
  EXPECT_EQ(error_of("\x93NUMPY\x07"), "a.npy: byte 6: found version 7, expected 1, 2 or 3");
  EXPECT_EQ(error_of("\x93NUMPY\x01"), "a.npy: byte 7: the file ends within the NPY header");
  EXPECT_EQ(error_of(npy_header("'<f8'", "(2, 3)").substr(0, 60)),
            "a.npy: byte 10: the NPY header ends early: 50 bytes, expected 118");
  EXPECT_EQ(error_of(std::string("\x93NUMPY\x01\0\x02\0{}", 12)),
            "a.npy: byte 10: the NPY header is incomplete, expected descr, fortran_order and shape");
  EXPECT_EQ(error_of(std::string("\x93NUMPY\x01\0\x0C\0{'descr' <f8", 22)),
            "a.npy: byte 19: in the NPY header found \"<f8\", expected :");
}

}  // namespace
}  // namespace trysquare
