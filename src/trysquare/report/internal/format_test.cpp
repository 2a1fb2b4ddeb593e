// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/format.h"

#include <gtest/gtest.h>

#include <string>

namespace trysquare::internal {
namespace {

TEST(Format, QuantitiesHaveFourSignificantDigitsAndTheirUnit) {
  EXPECT_EQ(quantity(0.0022034978851190544, "m2"), "0.002203\u00A0m²");
  EXPECT_EQ(quantity(-3.6144387057257514, "nats"), "−3.614\u00A0nats");
  EXPECT_EQ(quantity(18.8, "scans"), "18.80\u00A0scans");
  EXPECT_EQ(quantity(0.94, "deg"), "0.9400°");
  EXPECT_EQ(quantity(123456.7), "123457");
}

TEST(Format, VerySmallAndVeryLargeQuantitiesArePowersOfTen) {
  EXPECT_EQ(quantity(4.6899e-5, "m2"), "4.690 × 10⁻⁵\u00A0m²");
  EXPECT_EQ(quantity(-2.5e12), "−2.500 × 10¹²");
}

TEST(Format, RoundingUpToAPowerOfTenKeepsFourDigits) {
  EXPECT_EQ(quantity(9.99996e-5), "0.0001000");
  EXPECT_EQ(quantity(9.99996), "10.00");
  EXPECT_EQ(quantity(999999.6), "1.000 × 10⁶");
}

TEST(Format, ZeroHasNoSign) {
  EXPECT_EQ(quantity(0.0, "m"), "0\u00A0m");
  EXPECT_EQ(quantity(-0.0, "m"), "0\u00A0m");
  EXPECT_EQ(tick_label(-1e-12, 0.1), "0.0");
}

TEST(Format, CountsAreGroupedByThousands) {
  EXPECT_EQ(count(0), "0");
  EXPECT_EQ(count(999), "999");
  EXPECT_EQ(count(2452809), "2\u202F452\u202F809");
  EXPECT_EQ(count(-1000), "−1\u202F000");
}

TEST(Format, TicksOfOneAxisHaveTheSameDecimals) {
  EXPECT_EQ(tick_label(0.1, 0.05), "0.10");
  EXPECT_EQ(tick_label(-20, 20), "−20");
  EXPECT_EQ(tick_label(0.001, 0.001), "0.001");
}

TEST(Format, EscapedTextHasNoMarkup) {
  EXPECT_EQ(escape("<script a='b' c=\"d\">&"), "&lt;script a=&#39;b&#39; c=&quot;d&quot;&gt;&amp;");
  EXPECT_EQ(escape("naïve – ok"), "naïve – ok");
}

TEST(Format, CharactersThatXmlForbidsAreReplaced) {
  EXPECT_EQ(escape(std::string_view("a\0b", 3)), "a\uFFFDb");
  EXPECT_EQ(escape("\x1B[31m"), "\uFFFD[31m");
  EXPECT_EQ(escape("a\xEF\xBF\xBF"
                   "b"),
            "a\uFFFDb");
}

TEST(Format, TheReasonOfAKeyComesBeforeTheReasonOfItsObject) {
  const Json object = Json::parse(R"({"ape": null, "ape_reason": "on a line", "reason": "other"})");
  EXPECT_EQ(reason_of(object, "ape"), "on a line");
  EXPECT_EQ(reason_of(object, "rpe"), "other");
  EXPECT_EQ(reason_of(Json::object(), "rpe"), "no reason was given");
}

TEST(Format, KeysBecomeWordsAndUnits) {
  EXPECT_EQ(label_of("num_not_finite_points"), "number of not finite points");
  EXPECT_EQ(label_of("radius_m"), "radius");
  EXPECT_EQ(unit_of("radius_m"), "m");
  EXPECT_EQ(unit_of("min_neighbors"), "");
}

TEST(Format, LongListsAreCutAndSaySo) {
  EXPECT_EQ(joined({"a"}, 2), "a");
  EXPECT_EQ(joined({"a", "b"}, 2), "a and b");
  EXPECT_EQ(joined({"a", "b", "c"}, 2), "a, b and 1 more");
}

}  // namespace
}  // namespace trysquare::internal
