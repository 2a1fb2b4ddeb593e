// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/paired_test.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace trysquare {
namespace {

/// Every combination of signs, written out: the definition.
double p_value_by_definition(const std::vector<double>& differences) {
  const std::size_t n = differences.size();
  double observed = 0;
  for (const double each : differences) observed += each;
  double num_extreme = 0;
  for (unsigned signs = 0; signs < 1U << n; ++signs) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += (signs >> i & 1U) != 0 ? -differences[i] : differences[i];
    num_extreme += std::abs(sum) >= std::abs(observed) - 1e-12 ? 1 : 0;
  }
  return num_extreme / std::pow(2.0, static_cast<double>(n));
}

TEST(PairedTest, CountsTheCombinationsOfSigns) {
  const std::vector<double> differences = {0.3, -0.1, 0.7, 0.2, -0.4, 0.9, 0.15, 0.05};
  const PairedTest test = paired_test(differences);
  EXPECT_DOUBLE_EQ(test.p_value, p_value_by_definition(differences));
  EXPECT_NEAR(test.mean, 0.225, 1e-15);
  EXPECT_EQ(test.num_blocks, 8U);
}

TEST(PairedTest, IsAsSureAsSoManyPairsAllowWhenAllAgree) {
  const std::vector<double> differences(10, 0.5);
  EXPECT_DOUBLE_EQ(paired_test(differences).p_value, 2.0 / 1024);
  EXPECT_DOUBLE_EQ(paired_test(std::vector<double>(10, -0.5)).p_value, 2.0 / 1024);
  EXPECT_DOUBLE_EQ(least_p_value(10), 2.0 / 1024);
  EXPECT_DOUBLE_EQ(paired_test(std::vector<double>(40, 0.5)).p_value, least_p_value(40));
}

TEST(PairedTest, FindsNoDifferenceWhereThereIsNone) {
  const PairedTest test = paired_test(std::vector<double>(12, 0.0));
  EXPECT_EQ(test.p_value, 1);
  ASSERT_TRUE(test.interval);
  EXPECT_EQ(test.interval->low, 0);
  EXPECT_EQ(test.interval->high, 0);
}

/// The interval's ends are where the test turns over.
TEST(PairedTest, HasAnIntervalOfTheMeansThatTheTestDoesNotExclude) {
  const std::vector<double> differences = {1.0, 1.4, 0.7, 1.2, 0.9, 1.1, 1.3, 0.6, 1.05};
  const PairedTest test = paired_test(differences, 0.9);
  ASSERT_TRUE(test.interval);
  const auto p_if_mean_was = [&](double mean) {
    std::vector<double> shifted;
    for (const double each : differences) shifted.push_back(each - mean);
    return p_value_by_definition(shifted);
  };
  const double inward = 1e-6 * (test.interval->high - test.interval->low);
  EXPECT_LE(p_if_mean_was(test.interval->low - inward), 0.1);
  EXPECT_GT(p_if_mean_was(test.interval->low + inward), 0.1);
  EXPECT_LE(p_if_mean_was(test.interval->high + inward), 0.1);
  EXPECT_GT(p_if_mean_was(test.interval->high - inward), 0.1);
}

TEST(PairedTest, HasNoIntervalWithFivePairs) {
  EXPECT_FALSE(paired_test(std::vector<double>(5, 1.0)).interval);
  EXPECT_TRUE(paired_test(std::vector<double>(6, 1.0)).interval);
}

/// 64 differences of which each four in a row are equal are no more evidence than 16.
TEST(PairedTest, FlipsNeighborsTogether) {
  std::vector<double> once;
  std::vector<double> four_times;
  for (int i = 0; i < 16; ++i) {
    once.push_back(std::sin(3.0 * i) + 0.2);
    four_times.insert(four_times.end(), 4, once.back());
  }
  EXPECT_NEAR(paired_test(four_times).p_value, paired_test(once).p_value, 1e-12);
  EXPECT_EQ(paired_test(four_times).num_blocks, 16U);
}

TEST(PairedTest, RefusesWhatIsNoDifference) {
  EXPECT_THROW(paired_test({}), InvalidArgument);
  EXPECT_THROW(paired_test(std::vector<double>{1, std::numeric_limits<double>::quiet_NaN()}), InvalidArgument);
  EXPECT_THROW(paired_test(std::vector<double>{1, 2}, 1), InvalidArgument);
}

/// 0.005 · 5, 0.01 · 4, 0.03 · 3, then 0.04 · 2 = 0.08, which may not be below the one before, 0.9 · 1.
TEST(HolmAdjusted, MultipliesByTheTestsThatAreLeftAndNeverFalls) {
  const std::vector<double> adjusted = holm_adjusted(std::vector<double>{0.01, 0.04, 0.03, 0.005, 0.9});
  const std::vector<double> expected = {0.04, 0.09, 0.09, 0.025, 0.9};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(adjusted[i], expected[i], 1e-15) << i;
}

}  // namespace
}  // namespace trysquare
