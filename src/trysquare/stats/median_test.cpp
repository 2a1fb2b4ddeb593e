// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/median.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace trysquare {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(MedianOfDefined, IsTheMiddleValueOfAnOddCount) {
  EXPECT_EQ(median_of_defined(std::vector{9.0, 1.0, 5.0}), 5.0);
  EXPECT_EQ(median_of_defined(std::vector{-2.0}), -2.0);
}

TEST(MedianOfDefined, IsTheMeanOfTheMiddleTwoOfAnEvenCount) {
  EXPECT_EQ(median_of_defined(std::vector{10.0, 1.0, 4.0, 2.0}), 3.0);
}

TEST(MedianOfDefined, SkipsUndefinedValues) { EXPECT_EQ(median_of_defined(std::vector{kNan, 7.0, kNan, 5.0}), 6.0); }

TEST(MedianOfDefined, IsUndefinedWhenNothingIsDefined) {
  EXPECT_EQ(median_of_defined({}), std::nullopt);
  EXPECT_EQ(median_of_defined(std::vector{kNan}), std::nullopt);
}

TEST(MedianOfDefined, EqualsTheMiddleOfTheSortedListForEveryOrderOfSixValues) {
  std::vector<double> values{1, 2, 3, 5, 8, 13};
  do {
    ASSERT_EQ(median_of_defined(values), 4.0);
  } while (std::next_permutation(values.begin(), values.end()));
}

}  // namespace
}  // namespace trysquare
