// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/quantile.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

#include <vector>

namespace trysquare {
namespace {

TEST(Quantile, IsLinearBetweenTheRanks) {
  const std::vector<double> values = {1, 2, 4, 8};  // numpy.quantile([1, 2, 4, 8], [0, .25, .5, .9, 1])
  EXPECT_DOUBLE_EQ(quantile_of_sorted(values, 0), 1);
  EXPECT_DOUBLE_EQ(quantile_of_sorted(values, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(quantile_of_sorted(values, 0.5), 3);
  EXPECT_DOUBLE_EQ(quantile_of_sorted(values, 0.9), 6.8);
  EXPECT_DOUBLE_EQ(quantile_of_sorted(values, 1), 8);
}

TEST(Quantile, OfOneValueIsThatValue) {
  const std::vector<double> one = {5};
  EXPECT_EQ(quantile_of_sorted(one, 0.3), 5);
}

TEST(Quantile, RefusesNothingAndSharesOutOfRange) {
  const std::vector<double> one = {5};
  EXPECT_THROW(quantile_of_sorted({}, 0.5), InvalidArgument);
  EXPECT_THROW(quantile_of_sorted(one, 1.1), InvalidArgument);
  EXPECT_THROW(quantile_of_sorted(one, -0.1), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
