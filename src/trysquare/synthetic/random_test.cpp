// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace trysquare {
namespace {

// The first values of SplitMix64 for seed 1234567, as published with the generator (Vigna, splitmix64.c) and in many
// ports.
TEST(Random, IsSplitMix64) {
  Random random(1234567);
  EXPECT_EQ(random.bits(), 6457827717110365317u);
  EXPECT_EQ(random.bits(), 3203168211198807973u);
  EXPECT_EQ(random.bits(), 9817491932198370423u);
}

TEST(Random, UniformLiesInTheHalfOpenUnitIntervalAndFillsIt) {
  Random random(1);
  double lowest = 1;
  double highest = 0;
  double sum = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double value = random.uniform();
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
    sum += value;
  }
  EXPECT_GE(lowest, 0);
  EXPECT_LT(lowest, 1e-3);
  EXPECT_LT(highest, 1);
  EXPECT_GT(highest, 1 - 1e-3);
  EXPECT_NEAR(sum / 100'000, 0.5, 5 * std::sqrt(1.0 / 12 / 100'000));
}

TEST(Random, NormalHasTheMomentsOfTheNormalDistribution) {
  Random random(2);
  constexpr int kCount = 200'000;
  double sum[5] = {};
  double product = 0;  // of neighbors: the two values of one draw must not be related
  double last = 0;
  for (int i = 0; i < kCount; ++i) {
    const double value = random.normal();
    for (int power = 1; power <= 4; ++power) sum[power] += std::pow(value, power);
    product += value * last;
    last = value;
  }
  const double n = kCount;  // five standard errors each: variances of x, x², x³, x⁴ are 1, 2, 15, 96
  EXPECT_NEAR(sum[1] / n, 0, 5 * std::sqrt(1 / n));
  EXPECT_NEAR(sum[2] / n, 1, 5 * std::sqrt(2 / n));
  EXPECT_NEAR(sum[3] / n, 0, 5 * std::sqrt(15 / n));
  EXPECT_NEAR(sum[4] / n, 3, 5 * std::sqrt(96 / n));
  EXPECT_NEAR(product / n, 0, 5 * std::sqrt(1 / n));
}

TEST(Random, UnitDirectionsAreOfLengthOneAndUnbiased) {
  Random random(3);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (int i = 0; i < 30'000; ++i) {
    const Eigen::Vector3d direction = random.unit_direction();
    ASSERT_NEAR(direction.norm(), 1, 1e-15);
    sum += direction;
    squares += direction.cwiseAbs2();
  }
  EXPECT_LT((sum / 30'000).cwiseAbs().maxCoeff(), 5 * std::sqrt(1.0 / 3 / 30'000));
  EXPECT_LT((squares / 30'000).array().abs().maxCoeff() - 1.0 / 3, 5 * std::sqrt(4.0 / 45 / 30'000));
}

TEST(Random, StreamsOfDifferentSeedsAndItemsDiffer) {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    for (std::uint64_t index = 0; index < 30; ++index) first.insert(Random(seed, index).bits());
  }
  EXPECT_EQ(first.size(), 900u);
}

TEST(Random, StreamsOfNeighborsAreNotShiftedCopies) {
  std::set<std::uint64_t> values;
  for (std::uint64_t index = 0; index < 10; ++index) {
    Random random(5, index);
    for (int i = 0; i < 1000; ++i) values.insert(random.bits());
  }
  EXPECT_EQ(values.size(), 10'000u);
}

}  // namespace
}  // namespace trysquare
