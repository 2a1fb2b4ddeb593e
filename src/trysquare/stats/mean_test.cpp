// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/mean.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace trysquare {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(MeanOfDefined, IsSumOverCount) { EXPECT_EQ(mean_of_defined(std::vector{1.0, 2.0, 6.0}), 3.0); }

TEST(MeanOfDefined, SkipsUndefinedValuesInSumAndCount) {
  EXPECT_EQ(mean_of_defined(std::vector{kNan, 1.0, kNan, 3.0}), 2.0);
}

TEST(MeanOfDefined, IsUndefinedWhenNothingIsDefined) {
  EXPECT_EQ(mean_of_defined({}), std::nullopt);
  EXPECT_EQ(mean_of_defined(std::vector{kNan, kNan}), std::nullopt);
}

}  // namespace
}  // namespace trysquare
