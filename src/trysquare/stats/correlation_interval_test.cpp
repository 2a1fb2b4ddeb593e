// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/correlation_interval.h"

#include "trysquare/core/error.h"
#include "trysquare/stats/correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace trysquare {
namespace {

using enum Coefficient;
using Values = std::vector<double>;

/// Numbers in (0, 1) by a recurrence of their own.
struct Stream {
  std::uint64_t state;
  double operator()() {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (static_cast<double>(state >> 12) + 0.5) * 0x1p-52;
  }
};

/// Pairs of normal numbers with the given correlation (Box and Muller).
void normal_pairs(std::size_t n, double rho, std::uint64_t seed, Values& x, Values& y) {
  Stream uniform{seed};
  x.clear();
  y.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    const double angle = 2 * std::numbers::pi * uniform();
    const double a = radius * std::cos(angle);
    x.push_back(a);
    y.push_back(rho * a + std::sqrt(1 - rho * rho) * radius * std::sin(angle));
  }
}

// scipy.stats.pearsonr of 10 pairs, .confidence_interval(0.95), scipy 1.16.3: the values of correlation_test.cpp.
TEST(FisherInterval, IsThatOfScipyForPearson) {
  const Values x{2.5, 0.1, -3, 7, 7, 4.25, 1, 0, 9.5, -1};
  const Values y{1.5, 0.3, -2, 3, 8, 4.25, 4.25, -1, 5, -1};
  const Interval interval = *fisher_interval(kPearson, *pearson(x, y), 10);
  EXPECT_NEAR(interval.low, 0.3998856273415292, 1e-12);
  EXPECT_NEAR(interval.high, 0.9566724792052284, 1e-12);
}

TEST(FisherInterval, IsWiderForSpearmanAndNarrowerForKendall) {
  const double z = 1.959963984540054;
  EXPECT_NEAR(fisher_interval(kSpearman, 0.6, 103)->high, std::tanh(std::atanh(0.6) + z * std::sqrt(1.18 / 100)),
              1e-12);
  EXPECT_NEAR(fisher_interval(kKendallTauB, 0.6, 104)->low, std::tanh(std::atanh(0.6) - z * std::sqrt(0.00437)), 1e-12);
}

TEST(FisherInterval, NeedsMorePairsThanItsVarianceLoses) {
  EXPECT_EQ(fisher_interval(kPearson, 0.5, 3), std::nullopt);
  EXPECT_TRUE(fisher_interval(kPearson, 0.5, 4));
  EXPECT_EQ(fisher_interval(kKendallTauB, 0.5, 4), std::nullopt);
}

TEST(FisherInterval, HasNoWidthAtOne) {
  EXPECT_EQ(fisher_interval(kPearson, 1, 10)->low, 1);
  EXPECT_EQ(fisher_interval(kPearson, -1, 10)->high, -1);
}

TEST(FisherInterval, RefusesWhatIsNoCorrelationOrNoConfidence) {
  EXPECT_THROW(fisher_interval(kPearson, 1.1, 10), InvalidArgument);
  EXPECT_THROW(fisher_interval(kPearson, std::numeric_limits<double>::quiet_NaN(), 10), InvalidArgument);
  EXPECT_THROW(fisher_interval(kPearson, 0.5, 10, 1), InvalidArgument);
}

/// Of 400 samples of 100 pairs, 95 % of the intervals hold the true coefficient: ± 2 % is 1.9 standard errors.
TEST(BootstrapInterval, HoldsTheTruthAsOftenAsItSays) {
  const double rho = 0.7;
  const double tau = 2 / std::numbers::pi * std::asin(rho);
  int num_pearson = 0;
  int num_kendall = 0;
  Values x;
  Values y;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    normal_pairs(100, rho, seed, x, y);
    const Interval pearsons = *bootstrap_interval(kPearson, x, y, {.num_resamples = 200, .seed = seed});
    const Interval kendalls = *bootstrap_interval(kKendallTauB, x, y, {.num_resamples = 200, .seed = seed});
    num_pearson += pearsons.low <= rho && rho <= pearsons.high ? 1 : 0;
    num_kendall += kendalls.low <= tau && tau <= kendalls.high ? 1 : 0;
  }
  EXPECT_NEAR(num_pearson / 400.0, 0.95, 0.035);
  EXPECT_NEAR(num_kendall / 400.0, 0.95, 0.035);
}

TEST(BootstrapInterval, AgreesWithFishersForNormalPairs) {
  Values x;
  Values y;
  normal_pairs(2000, 0.8, 5, x, y);
  const Interval drawn = *bootstrap_interval(kPearson, x, y, {.num_resamples = 2000});
  const Interval computed = *fisher_interval(kPearson, *pearson(x, y), 2000);
  const double width = computed.high - computed.low;
  EXPECT_NEAR(drawn.low, computed.low, 0.15 * width);
  EXPECT_NEAR(drawn.high, computed.high, 0.15 * width);
}

TEST(BootstrapInterval, IsTheSameForTheSameSeed) {
  Values x;
  Values y;
  normal_pairs(30, 0.5, 1, x, y);
  const Interval a = *bootstrap_interval(kSpearman, x, y, {.seed = 3});
  EXPECT_EQ(bootstrap_interval(kSpearman, x, y, {.seed = 3})->low, a.low);
  EXPECT_NE(bootstrap_interval(kSpearman, x, y, {.seed = 4})->low, a.low);
}

TEST(BootstrapInterval, IsUndefinedWhereTheCoefficientIs) {
  EXPECT_EQ(bootstrap_interval(kPearson, Values{1, 1, 1}, Values{1, 2, 3}), std::nullopt);
  EXPECT_THROW(bootstrap_interval(kPearson, Values{1, 2}, Values{1}), InvalidArgument);
  EXPECT_THROW(bootstrap_interval(kPearson, Values{1, 2}, Values{1, 2}, {.num_resamples = 1}), InvalidArgument);
}

TEST(BootstrapIntervalOfMean, HasTheWidthOfTheStandardError) {
  Values x;
  Values unused;
  normal_pairs(400, 0, 9, x, unused);
  const Interval interval = *bootstrap_interval_of_mean(x, {.num_resamples = 4000});
  EXPECT_NEAR(interval.high - interval.low, 2 * 1.96 / 20, 0.1 * 2 * 1.96 / 20);
  EXPECT_EQ(bootstrap_interval_of_mean(Values{1}), std::nullopt);
}

}  // namespace
}  // namespace trysquare
