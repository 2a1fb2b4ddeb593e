// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/error_statistics.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trysquare {
namespace {

TEST(ErrorStatistics, AreThoseWorkedByHand) {
  const ErrorStatistics statistics = error_statistics(std::vector{4.0, 1.0, 2.0, 5.0});
  EXPECT_EQ(statistics.count, 4u);
  EXPECT_EQ(statistics.mean, 3);
  EXPECT_EQ(statistics.median, 3);
  EXPECT_EQ(statistics.min, 1);
  EXPECT_EQ(statistics.max, 5);
  EXPECT_EQ(statistics.sse, 46);
  EXPECT_DOUBLE_EQ(statistics.rmse, std::sqrt(11.5));
  EXPECT_DOUBLE_EQ(statistics.std, std::sqrt(2.5));  // (1 + 4 + 1 + 4) / 4: divisor n, not n − 1
}

TEST(ErrorStatistics, MeanMedianAndExtremesOfASkewedListDiffer) {
  const ErrorStatistics statistics = error_statistics(std::vector{10.0, 0.0, 2.0});
  EXPECT_EQ(statistics.mean, 4);
  EXPECT_EQ(statistics.median, 2);
  EXPECT_EQ(statistics.min, 0);
  EXPECT_EQ(statistics.max, 10);
}

TEST(ErrorStatistics, StandardDeviationOfNearlyEqualLargeValuesKeepsItsDigits) {
  // The difference of the mean square and the squared mean would be 0 or negative here.
  EXPECT_NEAR(error_statistics(std::vector{1e9 + 1, 1e9 + 2, 1e9 + 3}).std, std::sqrt(2.0 / 3), 1e-9);
}

TEST(ErrorStatistics, OfNothingAreRefused) { EXPECT_THROW(error_statistics({}), InvalidArgument); }

}  // namespace
}  // namespace trysquare
