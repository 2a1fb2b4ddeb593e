// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/correlation.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace trysquare {
namespace {

using Values = std::vector<double>;

/// Values with many ties (few levels) or without (many levels).
Values pseudo_random(std::size_t n, std::uint64_t levels, std::uint64_t state) {
  Values values;
  for (std::size_t i = 0; i < n; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    values.push_back(static_cast<double>((state >> 33) % levels));
  }
  return values;
}

int sign(double value) { return (value > 0) - (value < 0); }

double tau_b_by_definition(const Values& x, const Values& y) {
  double difference = 0;
  double not_tied_in_x = 0;
  double not_tied_in_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      difference += sign(x[i] - x[j]) * sign(y[i] - y[j]);
      not_tied_in_x += x[i] != x[j];
      not_tied_in_y += y[i] != y[j];
    }
  }
  return difference / std::sqrt(not_tied_in_x * not_tied_in_y);
}

/// Rank of a value: how many are smaller, plus half of those equal to it.
Values ranks_by_definition(const Values& values) {
  Values ranks;
  for (const double value : values) {
    double rank = 0;
    for (const double other : values) rank += other < value ? 1.0 : other == value ? 0.5 : 0.0;
    ranks.push_back(rank);
  }
  return ranks;
}

TEST(Pearson, IsThatWorkedByHand) {
  // Deviations (−2, −1, 0, 3) and (−1, −1, 1, 1): Σxy = 6, Σxx = 14, Σyy = 4.
  EXPECT_NEAR(*pearson(Values{0, 1, 2, 5}, Values{3, 3, 5, 5}), 6 / std::sqrt(56), 1e-15);
}

TEST(Pearson, IsOneOnARisingLineAndMinusOneOnAFallingOne) {
  EXPECT_DOUBLE_EQ(*pearson(Values{1, 2, 4}, Values{10, 20, 40}), 1);
  EXPECT_DOUBLE_EQ(*pearson(Values{1, 2, 4}, Values{-1, -2, -4}), -1);
}

TEST(Pearson, DoesNotOverflowUnderflowOrCancel) {
  EXPECT_NEAR(*pearson(Values{0, 1e-200, 2e-200, 5e-200}, Values{3e300, 3e300, 5e300, 5e300}), 6 / std::sqrt(56),
              1e-14);
  EXPECT_NEAR(*pearson(Values{1.2e308, 1.3e308, 1.4e308, 1.7e308}, Values{3, 3, 5, 5}), 6 / std::sqrt(56), 1e-14);
  EXPECT_NEAR(*pearson(Values{1e9, 1e9 + 1, 1e9 + 2, 1e9 + 5}, Values{3, 3, 5, 5}), 6 / std::sqrt(56), 1e-14);
}

/// 20,000 numbers near 1 that differ by 1e-9: the sum alone would put their mean a thousandth of that off.
TEST(Pearson, KeepsItsDigitsForManyNumbersThatHardlyDiffer) {
  const Values x = pseudo_random(20'000, 1000, 1);
  Values y = pseudo_random(20'000, 3, 2);
  const double expected = *pearson(x, y);
  for (double& value : y) value = 1 + 0x1p-30 * value;  // exact
  EXPECT_NEAR(*pearson(x, y), expected, 1e-14);
}

TEST(Spearman, FollowsTheOrderAndNotTheShape) {
  EXPECT_DOUBLE_EQ(*spearman(Values{1, 2, 3, 4}, Values{1, 10, 100, 1000}), 1);
  EXPECT_LT(*pearson(Values{1, 2, 3, 4}, Values{1, 10, 100, 1000}), 0.9);
}

TEST(Spearman, IsPearsonOfAverageRanks) {
  for (const std::uint64_t levels : {4u, 1000000u}) {
    const Values x = pseudo_random(200, levels, 1);
    const Values y = pseudo_random(200, levels, 2);
    EXPECT_NEAR(*spearman(x, y), *pearson(ranks_by_definition(x), ranks_by_definition(y)), 1e-14);
  }
}

TEST(KendallTauB, IsThatWorkedByHand) {
  // Of six pairs five are concordant and one, (3, 4) with (4, 3), is discordant.
  EXPECT_DOUBLE_EQ(*kendall_tau_b(Values{1, 2, 3, 4}, Values{1, 2, 4, 3}), 4.0 / 6);
  // Of the pairs of (1, 1), (1, 2), (2, 2), (3, 0) one is tied in x, one in y, one concordant, three discordant.
  EXPECT_NEAR(*kendall_tau_b(Values{1, 1, 2, 3}, Values{1, 2, 2, 0}), -2 / std::sqrt(25), 1e-15);
}

TEST(KendallTauB, EqualsTheDefinitionOverAllPairs) {
  for (const std::size_t n : {2u, 3u, 7u, 64u, 201u}) {
    for (const std::uint64_t levels : {3u, 20u, 1000000u}) {
      const Values x = pseudo_random(n, levels, 10 * n);
      const Values y = pseudo_random(n, levels, 11 * n + 1);
      const double expected = tau_b_by_definition(x, y);
      if (std::isnan(expected)) {
        EXPECT_EQ(kendall_tau_b(x, y), std::nullopt);
      } else {
        EXPECT_NEAR(*kendall_tau_b(x, y), expected, 1e-14) << n << " values, " << levels << " levels";
      }
    }
  }
}

// python3 -c "from scipy import stats; x=[2.5,.1,-3,7,7,4.25,1,0,9.5,-1]; y=[1.5,.3,-2,3,8,4.25,4.25,-1,5,-1];
//   print([repr(float(f(x, y).statistic)) for f in (stats.pearsonr, stats.spearmanr, stats.kendalltau)])"
//   (scipy 1.16.3)
TEST(Correlation, EqualsScipy) {
  const Values x{2.5, 0.1, -3, 7, 7, 4.25, 1, 0, 9.5, -1};
  const Values y{1.5, 0.3, -2, 3, 8, 4.25, 4.25, -1, 5, -1};
  EXPECT_NEAR(*pearson(x, y), 0.8224393701045404, 1e-14);
  EXPECT_NEAR(*spearman(x, y), 0.8929705363962265, 1e-14);
  EXPECT_NEAR(*kendall_tau_b(x, y), 0.7816608327818949, 1e-14);
}

class EveryCorrelation
    : public testing::TestWithParam<std::optional<double> (*)(std::span<const double>, std::span<const double>)> {};

TEST_P(EveryCorrelation, IsUndefinedForFewerThanTwoValues) {
  EXPECT_EQ(GetParam()({}, {}), std::nullopt);
  EXPECT_EQ(GetParam()(Values{1}, Values{1}), std::nullopt);
}

TEST_P(EveryCorrelation, IsUndefinedWhenOneSideDoesNotVary) {
  EXPECT_EQ(GetParam()(Values{0.1, 0.1, 0.1}, Values{1, 2, 3}), std::nullopt);
  EXPECT_EQ(GetParam()(Values{1, 2, 3}, Values{0.1, 0.1, 0.1}), std::nullopt);
}

TEST_P(EveryCorrelation, RefusesSizesThatDiffer) { EXPECT_THROW(GetParam()(Values{1, 2}, Values{1}), InvalidArgument); }

TEST_P(EveryCorrelation, RefusesValuesThatAreNotFinite) {
  EXPECT_THROW(GetParam()(Values{1, std::numeric_limits<double>::quiet_NaN()}, Values{1, 2}), InvalidArgument);
  EXPECT_THROW(GetParam()(Values{1, 2}, Values{std::numeric_limits<double>::infinity(), 1}), InvalidArgument);
}

TEST_P(EveryCorrelation, DoesNotDependOnTheOrderOfThePoints) {
  Values x = pseudo_random(99, 10, 5);
  Values y = pseudo_random(99, 10, 6);
  const double before = *GetParam()(x, y);
  std::reverse(x.begin(), x.end());
  std::reverse(y.begin(), y.end());
  EXPECT_NEAR(*GetParam()(x, y), before, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Coefficients, EveryCorrelation, testing::Values(&pearson, &spearman, &kendall_tau_b));

}  // namespace
}  // namespace trysquare
