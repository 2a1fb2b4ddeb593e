// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_ply.h"

#include "trysquare/io/internal/test_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using internal::bytes_of;
using internal::bytes_of_all;
using internal::io_error_of;
using testing::ElementsAre;
using testing::HasSubstr;

std::string header(const std::string& format, const std::string& elements) {
  return "ply\nformat " + format + " 1.0\ncomment made by a test\n" + elements + "end_header\n";
}

const std::string kTwoFloats = "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n";
const std::vector<Eigen::Vector3d> kTwoPoints = {{1, 2, 3}, {4, 5, 6}};

PointTable parse(const std::string& bytes) { return parse_ply(bytes, "a.ply", Columns::kAll); }

std::string error_of(const std::string& bytes) {
  return io_error_of([&] { parse(bytes); });
}

TEST(ParsePly, ReadsAscii) { EXPECT_EQ(parse(header("ascii", kTwoFloats) + "1 2 3\n4 5 6\n").points, kTwoPoints); }

TEST(ParsePly, ReadsBothByteOrders) {
  const std::vector<double> values = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ(parse(header("binary_little_endian", kTwoFloats) + bytes_of_all<float>(values)).points, kTwoPoints);
  EXPECT_EQ(parse(header("binary_big_endian", kTwoFloats) + bytes_of_all<float>(values, std::endian::big)).points,
            kTwoPoints);
}

TEST(ParsePly, ReadsCrlfHeaders) {
  std::string text = header("binary_little_endian", kTwoFloats);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  EXPECT_EQ(parse(text + bytes_of_all<float>({1, 2, 3, 4, 5, 6})).points, kTwoPoints);
}

TEST(ParsePly, ReadsEveryTypeInBothSpellings) {
  const std::vector<std::array<std::string, 8>> spellings = {
      {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"},
      {"int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"}};
  for (const std::array<std::string, 8>& names : spellings) {
    std::string elements = "element vertex 1\n";
    for (const std::string& name : names) elements += "property " + name + " v_" + name + "\n";
    for (const char* axis : {"x", "y", "z"}) elements += "property " + names[7] + " " + axis + "\n";
    for (const std::endian order : {std::endian::little, std::endian::big}) {
      const std::string body = bytes_of(std::int8_t{-1}, order) + bytes_of(std::uint8_t{255}, order) +
                               bytes_of(std::int16_t{-300}, order) + bytes_of(std::uint16_t{65535}, order) +
                               bytes_of(std::int32_t{-70000}, order) + bytes_of(std::uint32_t{4000000000}, order) +
                               bytes_of(0.5F, order) + bytes_of(0.1, order) + bytes_of(0.2, order) +
                               bytes_of(0.3, order) + bytes_of(0.4, order);
      const bool little = order == std::endian::little;
      const PointTable table = parse(header(little ? "binary_little_endian" : "binary_big_endian", elements) + body);
      EXPECT_THAT(table.points, ElementsAre(Eigen::Vector3d(0.2, 0.3, 0.4)));
      std::vector<double> values;
      for (const PointTable::Column& column : table.columns) values.push_back(column.values.at(0));
      EXPECT_THAT(values, ElementsAre(-1, 255, -300, 65535, -70000, 4e9, 0.5, 0.1));
      EXPECT_EQ(table.columns[0].name, "v_" + names[0]);
    }
  }
}

TEST(ParsePly, StepsOverElementsBeforeTheVertices) {
  const std::string elements =
      "element camera 2\nproperty double a\nproperty uchar b\nelement strip 2\nproperty list uchar int items\n" +
      kTwoFloats + "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string binary = std::string(18, 'c') + bytes_of(std::uint8_t{2}) + std::string(8, 's') +
                             bytes_of(std::uint8_t{0}) + bytes_of_all<float>({1, 2, 3, 4, 5, 6}) + "rest";
  EXPECT_EQ(parse(header("binary_little_endian", elements) + binary).points, kTwoPoints);
  EXPECT_EQ(parse(header("ascii", elements) + "0.5 1\n0.5 2\n2 8 9\n0\n1 2 3\n4 5 6\n3 0 1 0\n").points, kTwoPoints);
}

TEST(ParsePly, StepsOverListsInVertices) {
  const std::string elements =
      "element vertex 2\nproperty float x\nproperty list ushort double w\nproperty float y\nproperty float z\nproperty "
      "uchar c\n";
  const std::string binary = bytes_of(1.0F) + bytes_of(std::uint16_t{2}) + std::string(16, 'w') + bytes_of(2.0F) +
                             bytes_of(3.0F) + "\x07" + bytes_of(4.0F) + bytes_of(std::uint16_t{0}) + bytes_of(5.0F) +
                             bytes_of(6.0F) + "\x08";
  for (const PointTable& table : {parse(header("binary_little_endian", elements) + binary),
                                  parse(header("ascii", elements) + "1 2 0.5 0.5 2 3 7\n4 0 5 6 8\n")}) {
    EXPECT_EQ(table.points, kTwoPoints);
    ASSERT_EQ(table.columns.size(), 1U);
    EXPECT_THAT(table.columns[0].values, ElementsAre(7, 8));
  }
}

TEST(ParsePly, ZeroVerticesAreAnEmptyCloud) {
  const std::string elements = "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n";
  for (const char* format : {"ascii", "binary_little_endian"})
    EXPECT_EQ(parse(header(format, elements)).points.size(), 0U);
}

TEST(ParsePly, RefusesAnEmptyFileAndOtherFiles) {
  EXPECT_EQ(error_of(""), "a.ply: byte 0: the file is empty, expected a PLY header");
  EXPECT_EQ(error_of("VERSION 0.7\n"), "a.ply: line 1: found \"VERSION 0.7\", expected ply");
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\n"),
            "a.ply: byte 21: the file ends within the header, expected end_header");
  EXPECT_EQ(error_of(std::string("ply\nfor\0mat", 11)),
            "a.ply: byte 7: found a NUL byte, expected the text of a PLY header");
}

TEST(ParsePly, SaysHowManyBytesAreThereAndNeeded) {
  const std::string binary = header("binary_little_endian", kTwoFloats);
  EXPECT_EQ(error_of(binary + std::string(23, 'x')),
            "a.ply: byte " + std::to_string(binary.size()) +
                ": the file ends early: 23 bytes from here, expected 2 of element \"vertex\" with 12 bytes or more");
  const std::string ascii = header("ascii", kTwoFloats);
  EXPECT_EQ(error_of(ascii + "1 2 3\n"), "a.ply: byte " + std::to_string(ascii.size()) +
                                             ": the file ends early: 6 bytes from here, expected 2 lines of 3 values");
  EXPECT_EQ(error_of(ascii + "1.0000 2 3.00\n"), "a.ply: byte " + std::to_string(ascii.size() + 14) +
                                                     ": the file ends early, expected 2 of element \"vertex\"");
}

TEST(ParsePly, RefusesClaimsThatTheBytesCannotHold) {
  const std::string many = "element vertex 1000000000000\nproperty float x\nproperty float y\nproperty float z\n";
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    EXPECT_THAT(error_of(header(format, many)),
                HasSubstr("the file ends early: 0 bytes from here, expected 1000000000000"));
    EXPECT_THAT(error_of(header(format, "element face 1000000000000\nproperty list uchar int i\n" + kTwoFloats)),
                HasSubstr("the file ends early: 0 bytes from here, expected 1000000000000"));
  }
  EXPECT_EQ(error_of(header("ascii", "element nothing 1000000000000\n" + kTwoFloats)),
            "a.ply: line 4: element \"nothing\" has no properties");
}

TEST(ParsePly, RefusesListsThatCannotBe) {
  const std::string elements = "element face 1\nproperty list int int i\n" + kTwoFloats;
  const std::string binary = header("binary_little_endian", elements);
  const std::string rest(24, '\0');
  EXPECT_THAT(error_of(binary + bytes_of(std::int32_t{-1}) + rest),
              HasSubstr("byte " + std::to_string(binary.size() + 4) + ": found a list of -1 items of 4 bytes"));
  EXPECT_THAT(error_of(binary + bytes_of(std::int32_t{2000000000}) + rest),
              HasSubstr("found a list of 2000000000 items"));
  const std::string ascii = header(
      "ascii", "element vertex 1\nproperty list int int i\nproperty float x\nproperty float y\nproperty float z\n");
  EXPECT_THAT(error_of(ascii + "-1 1 2 3\n"), HasSubstr("line 10: found a list of -1 items"));
  EXPECT_THAT(error_of(ascii + "1e300 1 2 3\n"), HasSubstr("line 10: found a list of 1e+300 items"));
  EXPECT_THAT(error_of(ascii + "0.5 1 2 3\n"), HasSubstr("line 10: found a list of 0.5 items"));
  EXPECT_THAT(error_of(ascii + "nan 1 2 3\n"), HasSubstr("line 10: found a list of nan items"));
}

TEST(ParsePly, RefusesBadHeaderLines) {
  EXPECT_EQ(error_of(header("ascii", "element vertex -5\n")),
            "a.ply: line 4: found the count \"-5\", expected element NAME and a whole number that is not negative");
  EXPECT_EQ(error_of(header("ascii", "element vertex\n")),
            "a.ply: line 4: found the count \"\", expected element NAME and a whole number that is not negative");
  EXPECT_THAT(error_of(header("zipped", kTwoFloats)),
              HasSubstr("line 2: found the format \"zipped\", expected ascii,"));
  EXPECT_THAT(error_of("ply\nformat ascii 2.0\n"), HasSubstr("line 2: found the format \"ascii\""));
  EXPECT_THAT(error_of(header("ascii", "property float x\n")),
              HasSubstr("line 4: found \"property\" before any element"));
  EXPECT_THAT(error_of(header("ascii", "element vertex 1\nproperty quad x\n")),
              HasSubstr("line 5: found the type \"quad\""));
  EXPECT_THAT(error_of(header("ascii", "element vertex 1\nproperty list float int x\n")),
              HasSubstr("line 5: the number of items has the type \"float\""));
  EXPECT_THAT(error_of(header("ascii", "element vertex 1\nproperty float\n")),
              HasSubstr("line 5: found \"property\" with another number of words"));
  EXPECT_THAT(error_of(header("ascii", "vertices 7\n")),
              HasSubstr("line 4: found \"vertices\", expected format, element"));
  EXPECT_THAT(error_of(header("ascii", kTwoFloats + kTwoFloats)),
              HasSubstr("line 8: found a second element \"vertex\""));
  EXPECT_THAT(error_of("ply\nelement vertex 0\nproperty float x\nend_header\n"),
              HasSubstr("line 4: found \"end_header\", expected a format line before it"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\nformat ascii 1.0\n"), HasSubstr("line 3: found a second format"));
}

TEST(ParsePly, RefusesMissingAndDoubleCoordinates) {
  EXPECT_THAT(error_of(header("ascii", "element face 0\nproperty float x\n")),
              HasSubstr("line 6: found \"end_header\", expected an element vertex before it"));
  EXPECT_EQ(error_of(header("ascii", "element vertex 1\nproperty float x\nproperty float y\n")),
            "a.ply: line 4: no field z, expected x, y and z; found \"x\" \"y\"");
  EXPECT_EQ(error_of(header("ascii", kTwoFloats + "property float z\n")),
            "a.ply: line 4: there are two fields z, expected one");
  EXPECT_THAT(
      error_of(header("ascii", "element vertex 1\nproperty list uchar float x\nproperty float y\nproperty float z\n")),
      HasSubstr("no field x"));
}

TEST(ParsePly, RefusesTextAndWrongNumbersOfValues) {
  const std::string ascii = header("ascii", kTwoFloats);
  EXPECT_EQ(error_of(ascii + "1 2 3\n4 five 6\n"), "a.ply: line 10: value 2 is \"five\", expected a number");
  EXPECT_EQ(error_of(ascii + "1 2 3\n4 5000\n"), "a.ply: line 10: found 2 values, expected more");
  EXPECT_EQ(error_of(ascii + "1 2 3\n4 5 6 7\n"), "a.ply: line 10: found 4 values, expected 3");
}

}  // namespace
}  // namespace trysquare
