// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/association.h"

#include "trysquare/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace trysquare {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Poses whose x is their index.
Trajectory at(std::vector<std::int64_t> stamps_ns) {
  Trajectory trajectory{{}, std::move(stamps_ns)};
  for (std::size_t i = 0; i < trajectory.stamps_ns.size(); ++i) {
    trajectory.world_from_scan.push_back({.translation = {static_cast<double>(i), 0, 0}});
  }
  return trajectory;
}

std::vector<int> indices(const Trajectory& trajectory) {
  std::vector<int> result;
  for (const Pose& pose : trajectory.world_from_scan) result.push_back(static_cast<int>(pose.translation.x()));
  return result;
}

constexpr std::int64_t kMs = 1'000'000;

TEST(Associate, PairsEachPoseOfTheShorterWithTheNearestOfTheLonger) {
  const auto pairs = associate(at({0, 10 * kMs, 20 * kMs, 30 * kMs, 40 * kMs}), at({9 * kMs, 31 * kMs}));
  EXPECT_THAT(indices(pairs.reference), ElementsAre(1, 3));
  EXPECT_THAT(indices(pairs.estimate), ElementsAre(0, 1));
  EXPECT_THAT(pairs.reference.stamps_ns, ElementsAre(10 * kMs, 30 * kMs));
  EXPECT_EQ(pairs.num_pairs, 2u);
  EXPECT_EQ(pairs.num_unmatched_reference, 3u);
  EXPECT_EQ(pairs.num_unmatched_estimate, 0u);
  EXPECT_FALSE(pairs.by_index);
}

TEST(Associate, SearchesInTheEstimateWhenThatIsLonger) {
  const auto pairs = associate(at({9 * kMs, 31 * kMs}), at({0, 10 * kMs, 20 * kMs, 30 * kMs, 40 * kMs}));
  EXPECT_THAT(indices(pairs.reference), ElementsAre(0, 1));
  EXPECT_THAT(indices(pairs.estimate), ElementsAre(1, 3));
  EXPECT_EQ(pairs.num_unmatched_estimate, 3u);
}

TEST(Associate, OfEqualLengthsTheEstimateSearchesTheReference) {
  // Both estimated poses are nearest to reference 0. The other way round reference 1 would be paired.
  const auto pairs = associate(at({0, 9 * kMs}), at({1 * kMs, 2 * kMs}));
  EXPECT_THAT(indices(pairs.reference), ElementsAre(0, 0));
  EXPECT_THAT(indices(pairs.estimate), ElementsAre(0, 1));
  EXPECT_EQ(pairs.num_unmatched_reference, 1u);
}

TEST(Associate, TheLargestDifferenceIsInclusive) {
  EXPECT_EQ(associate(at({0, 100 * kMs}), at({10 * kMs, 110 * kMs + 100})).num_pairs, 1u);
  EXPECT_EQ(associate(at({0, 100 * kMs}), at({10 * kMs, 110 * kMs + 100}), {.max_difference_s = 0.0100002}).num_pairs,
            2u);
}

TEST(Associate, AddsTheOffsetToTheEstimateAndKeepsItsStamps) {
  for (const bool estimate_is_longer : {false, true}) {
    const Trajectory reference = at({1000 * kMs, 2000 * kMs});
    const Trajectory estimate =
        estimate_is_longer ? at({500 * kMs, 1500 * kMs, 9000 * kMs}) : at({500 * kMs, 1500 * kMs});
    const auto pairs = associate(reference, estimate, {.offset_s = 0.5});
    EXPECT_THAT(indices(pairs.reference), ElementsAre(0, 1));
    EXPECT_THAT(pairs.estimate.stamps_ns, ElementsAre(500 * kMs, 1500 * kMs));
    EXPECT_THROW(associate(reference, estimate, {.max_difference_s = 0.2, .offset_s = -0.25}), InvalidArgument);
  }
}

TEST(Associate, OfTwoEquallyNearTheEarlierIndexWins) {
  EXPECT_THAT(indices(associate(at({0, 2 * kMs}), at({1 * kMs})).reference), ElementsAre(0));
  EXPECT_THAT(indices(associate(at({2 * kMs, 0}), at({1 * kMs})).reference), ElementsAre(0));
  EXPECT_THAT(indices(associate(at({50 * kMs, 0, 0}), at({1 * kMs})).reference), ElementsAre(1));
}

TEST(Associate, FindsTheNearestStampInAnyOrderAsASearchOverAllDoes) {
  std::vector<std::int64_t> reference_ns;
  std::vector<std::int64_t> estimate_ns;
  std::uint64_t state = 7;
  // Multiples of 1/512 s, up to 2 s, many equal: exact in doubles, so that ties are ties.
  const auto next = [&] {
    return 1'953'125 * static_cast<std::int64_t>((state = state * 6364136223846793005u + 1) >> 54);
  };
  for (int i = 0; i < 400; ++i) reference_ns.push_back(next());
  for (int i = 0; i < 300; ++i) estimate_ns.push_back(next());
  std::vector<int> expected;
  for (const std::int64_t stamp : estimate_ns) {
    std::size_t best = 0;
    for (std::size_t j = 0; j < reference_ns.size(); ++j) {
      if (std::abs(reference_ns[j] - stamp) < std::abs(reference_ns[best] - stamp)) best = j;
    }
    expected.push_back(static_cast<int>(best));
  }
  EXPECT_EQ(indices(associate(at(reference_ns), at(estimate_ns), {.max_difference_s = 9}).reference), expected);
}

TEST(Associate, WithoutStampsPairsByIndex) {
  Trajectory reference = at({0, 1, 2});
  reference.stamps_ns.clear();
  const auto pairs = associate(reference, at({50, 60, 70}));
  EXPECT_TRUE(pairs.by_index);
  EXPECT_EQ(pairs.num_pairs, 3u);
  EXPECT_THAT(indices(pairs.estimate), ElementsAre(0, 1, 2));
}

TEST(Associate, WithoutStampsDifferentCountsAreRefusedNamingBoth) {
  Trajectory reference = at({0, 1, 2});
  reference.stamps_ns.clear();
  try {
    associate(reference, at({0, 1}));
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_THAT(error.what(), HasSubstr("3 poses"));
    EXPECT_THAT(error.what(), HasSubstr("estimate 2"));
  }
}

TEST(Associate, RefusesTrajectoriesThatDoNotMeetEmptyOnesAndMissingStamps) {
  EXPECT_THROW(associate(at({0}), at({11 * kMs})), InvalidArgument);
  EXPECT_THROW(associate(at({}), at({0})), InvalidArgument);
  EXPECT_THROW(associate(at({0}), at({})), InvalidArgument);
  Trajectory damaged = at({0, 1});
  damaged.stamps_ns.pop_back();
  EXPECT_THROW(associate(damaged, at({0, 1})), InvalidArgument);
}

TEST(Associate, RefusesSettingsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(associate(at({0}), at({0}), {.max_difference_s = -1}), InvalidArgument);
  EXPECT_THROW(associate(at({0}), at({0}), {.max_difference_s = nan}), InvalidArgument);
  EXPECT_THROW(associate(at({0}), at({0}), {.offset_s = nan}), InvalidArgument);
}

// TUM fr2_desk, estimated pose 1797: 1.65 ms from two poses of the reference. evo, in doubles, takes the later one.
TEST(Associate, RoundsStampsToDoublesAsEvoDoes) {
  const auto pairs = associate(at({1311868226'309'300'000, 1311868226'312'600'000}), at({1311868226'310'950'000}));
  EXPECT_THAT(indices(pairs.reference), ElementsAre(1));
}

TEST(Associate, NegativeStampsAndThoseAtTheEndsOf64BitsWork) {
  const std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
  const std::int64_t highest = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(associate(at({lowest, highest}), at({highest})).num_pairs, 1u);
  EXPECT_THAT(indices(associate(at({-1500 * kMs, -500 * kMs, 500 * kMs}), at({-501 * kMs})).reference), ElementsAre(1));
}

TEST(Associate, IsFarFromQuadratic) {
  std::vector<std::int64_t> stamps;
  for (std::int64_t i = 0; i < 200'000; ++i) stamps.push_back(i * 1000);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(associate(at(stamps), at(stamps)).num_pairs, stamps.size());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));  // all against all: 4e10 comparisons
}

TEST(Associate, OneToOneKeepsTheNearestOfThoseThatShareAPose) {
  const Trajectory reference = at({0, 100 * kMs, 200 * kMs});
  const Trajectory estimate = at({3 * kMs, 2 * kMs, 101 * kMs});
  EXPECT_THAT(indices(associate(reference, estimate).reference), ElementsAre(0, 0, 1));
  const auto pairs = associate(reference, estimate, {.one_to_one = true});
  EXPECT_THAT(indices(pairs.reference), ElementsAre(0, 1));
  EXPECT_THAT(indices(pairs.estimate), ElementsAre(1, 2));
  EXPECT_THAT(pairs.estimate_indices, ElementsAre(1u, 2u));
  EXPECT_EQ(pairs.num_unmatched_estimate, 1u);
}

TEST(Associate, SaysTheMedianDifference) {
  EXPECT_NEAR(
      associate(at({0, 100 * kMs, 200 * kMs}), at({-3 * kMs, 101 * kMs, 202 * kMs})).median_difference_s.value(), 0.002,
      1e-15);
  Trajectory reference = at({0, 1});
  reference.stamps_ns.clear();
  EXPECT_FALSE(associate(reference, at({0, 1})).median_difference_s.has_value());
}

TEST(Associate, InterpolatesTheReferenceToTheTimesOfTheEstimate) {
  const auto pairs =
      associate(at({0, 100 * kMs, 200 * kMs}), at({-5 * kMs, 25 * kMs, 190 * kMs, 201 * kMs}), {.interpolate = true});
  ASSERT_EQ(pairs.num_pairs, 2u);
  EXPECT_DOUBLE_EQ(pairs.reference.world_from_scan[0].translation.x(), 0.25);
  EXPECT_DOUBLE_EQ(pairs.reference.world_from_scan[1].translation.x(), 1.9);
  EXPECT_THAT(indices(pairs.estimate), ElementsAre(1, 2));
  EXPECT_THAT(pairs.reference.stamps_ns, ElementsAre(25 * kMs, 190 * kMs));
  EXPECT_EQ(pairs.num_extrapolated, 2u);
  EXPECT_EQ(pairs.num_unmatched_estimate, 2u);
  EXPECT_EQ(pairs.num_unmatched_reference, 1u);
  EXPECT_NEAR(pairs.median_difference_s.value(), 0.0175, 1e-15);
}

TEST(Associate, InterpolatesWithTheOffsetAndAcrossNoGap) {
  const Trajectory reference = at({0, 100 * kMs, 5000 * kMs});
  const auto pairs = associate(reference, at({1050 * kMs, 2000 * kMs}), {.offset_s = -1, .interpolate = true});
  ASSERT_EQ(pairs.num_pairs, 1u);
  EXPECT_DOUBLE_EQ(pairs.reference.world_from_scan[0].translation.x(), 0.5);
  EXPECT_EQ(pairs.num_extrapolated, 0u);
  EXPECT_EQ(associate(reference, at({50 * kMs, 2000 * kMs}), {.interpolate = true, .max_gap_s = 4.9}).num_pairs, 2u);
  EXPECT_THROW(associate(reference, at({2000 * kMs}), {.interpolate = true}), InvalidArgument);
  EXPECT_THROW(associate(reference, at({0}), {.interpolate = true, .max_gap_s = 0}), InvalidArgument);
  EXPECT_THROW(associate(reference, at({0}), {.one_to_one = true, .interpolate = true}), InvalidArgument);
}

TEST(NearestInTime, GivesEachQueryTheStampNearestToIt) {
  const std::vector<std::int64_t> stamps = {3'000'000'000, 1'000'000'000, 2'000'000'000};
  const std::vector<std::int64_t> queries = {1'004'000'000, 2'996'000'000, 1'500'000'000, 1'000'000'000};
  EXPECT_EQ(nearest_in_time(queries, stamps, 0.01), (std::vector<std::optional<std::size_t>>{1, 0, std::nullopt, 1}));
}

TEST(NearestInTime, FindsNothingWhereNothingIs) {
  const std::vector<std::int64_t> queries = {1};
  EXPECT_EQ(nearest_in_time(queries, {}, 1.0), (std::vector<std::optional<std::size_t>>{std::nullopt}));
  EXPECT_THROW(nearest_in_time(queries, queries, -1.0), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
