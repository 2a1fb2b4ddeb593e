// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/text.h"

#include "trysquare/io/internal/test_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <locale>

namespace trysquare::internal {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  split_fields(line, fields);
  return fields;
}

TEST(LineReader, GivesLinesWithoutLineEndsAndByteOrderMark) {
  LineReader lines(
      "\xEF\xBB\xBF"
      "a b\r\n\nc");
  std::string_view line;
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "a b");
  EXPECT_EQ(lines.offset(), 8U);
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "");
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "c");
  EXPECT_EQ(lines.line_number(), 3U);
  EXPECT_FALSE(lines.next(line));
}

TEST(Fields, PartAtWhiteSpaceCommasAndSemicolons) {
  EXPECT_THAT(fields_of(" 1\t2 ,3; 4  "), ElementsAre("1", "2", "3", "4"));
  EXPECT_THAT(fields_of(" \t"), IsEmpty());
}

TEST(Fields, KeepTheEmptyOneBetweenTwoCommas) {
  EXPECT_THAT(fields_of("1,,3"), ElementsAre("1", "", "3"));
  EXPECT_THAT(fields_of(",2"), ElementsAre("", "2"));
}

TEST(Fields, IgnoreOneSeparatorAtTheEnd) { EXPECT_THAT(fields_of("1,2, "), ElementsAre("1", "2")); }

TEST(ParseDouble, TakesWholeTokensOnly) {
  EXPECT_EQ(parse_double("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parse_double("+.5"), 0.5);
  for (const char* token : {"", "1x", "0x10", "1,5", "+-1", "--1", "1e", "e5", "++1", " 1"}) {
    EXPECT_EQ(parse_double(token), std::nullopt) << token;
  }
}

TEST(ParseDouble, TakesNanAndInfinity) {
  EXPECT_TRUE(std::isnan(parse_double("nan").value()));
  EXPECT_TRUE(std::isnan(parse_double("-NaN").value()));
  EXPECT_EQ(parse_double("-inf"), -std::numeric_limits<double>::infinity());
}

TEST(ParseDouble, BeyondItsRangeIsInfiniteOrZero) {
  EXPECT_EQ(parse_double("-1e999"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(parse_double("1e-999"), 0.0);
  EXPECT_EQ(parse_double(std::string(400, '9')), std::numeric_limits<double>::infinity());
  EXPECT_EQ(parse_double("0." + std::string(400, '0') + "1"), 0.0);
}

TEST(ParseDouble, DoesNotHearTheLocale) {
  struct DecimalComma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  EXPECT_EQ(parse_double("1.5"), 1.5);
  std::locale::global(before);
}

TEST(ParseScaledInteger, IsExactWhereADoubleIsNot) {
  EXPECT_EQ(parse_scaled_integer("1311868164.363181", 9), 1311868164363181000);
  EXPECT_EQ(parse_scaled_integer("1403715529.112143517", 9), 1403715529112143517);
  EXPECT_EQ(parse_scaled_integer("1.403715529112143517e+09", 9), 1403715529112143517);
  EXPECT_EQ(parse_scaled_integer("1403715524907143168", 0), 1403715524907143168);
  EXPECT_EQ(parse_scaled_integer("-0.5", 9), -500000000);
}

TEST(ParseScaledInteger, RoundsToTheNearest) {
  EXPECT_EQ(parse_scaled_integer("0.0000000014", 9), 1);
  EXPECT_EQ(parse_scaled_integer("0.0000000015", 9), 2);
  EXPECT_EQ(parse_scaled_integer("0.00000000051", 9), 1);
  EXPECT_EQ(parse_scaled_integer("0.00000000049", 9), 0);
  EXPECT_EQ(parse_scaled_integer("0.0000000000099", 9), 0);
}

TEST(ParseScaledInteger, RefusesWhatHasNoPlaceIn64Bits) {
  EXPECT_EQ(parse_scaled_integer("9223372036.854775807", 9), std::numeric_limits<std::int64_t>::max());
  for (const char* token :
       {"9223372036.854775808", "1e99", "1e999999999999", "nan", "inf", "", "-", ".", "1.2.3", "12s"}) {
    EXPECT_EQ(parse_scaled_integer(token, 9), std::nullopt) << token;
  }
}

TEST(PrintedDecimals, CountsWhatWasPrinted) {
  EXPECT_EQ(printed_decimals("-0.1357"), 4);
  EXPECT_EQ(printed_decimals("1.2340"), 4);
  EXPECT_EQ(printed_decimals("1.25e-02"), 4);
  EXPECT_EQ(printed_decimals("12.5e+01"), 0);
  EXPECT_EQ(printed_decimals("17"), 0);
  EXPECT_EQ(printed_decimals("0.000000000"), 9);
}

TEST(ReadNumbers, NameTheLineAndTheValue) {
  std::vector<double> values;
  EXPECT_EQ(io_error_of([&] { read_numbers("a.xyz", 7, "1 2 z\x01", values); }),
            "a.xyz: line 7: value 3 is \"z\\x01\", expected a number");
  EXPECT_EQ(io_error_of([&] { read_numbers("a.xyz", 7, "1,,3", values); }),
            "a.xyz: line 7: value 2 is \"\", expected a number");
}

TEST(InQuotes, ShortensLongTokens) {
  EXPECT_EQ(in_quotes(std::string(1000, 'a')), "\"" + std::string(40, 'a') + "…\"");
}

}  // namespace
}  // namespace trysquare::internal
