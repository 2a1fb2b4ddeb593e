// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/pose_pairs.h"

#include "trysquare/core/error.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace trysquare {

void PrintTo(const PosePair& pair, std::ostream* out) { *out << '(' << pair.first << ", " << pair.second << ')'; }

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Pairs = std::vector<PosePair>;

Trajectory on_a_line(const std::vector<double>& x_m) {
  Trajectory trajectory;
  for (const double x : x_m) trajectory.world_from_scan.push_back({.translation = {x, 0, 0}});
  return trajectory;
}

Trajectory turned(const std::vector<double>& yaw_deg) {
  Trajectory trajectory;
  for (const double yaw : yaw_deg) {
    const Eigen::AngleAxisd rotation(yaw * std::numbers::pi / 180, Eigen::Vector3d::UnitZ());
    trajectory.world_from_scan.push_back({.rotation = rotation.toRotationMatrix()});
  }
  return trajectory;
}

TEST(PosePairs, ByFramesConsecutiveOnesShareTheirEnds) {
  EXPECT_THAT(pose_pairs(on_a_line({0, 0, 0, 0, 0, 0}), {.delta = 2}), ElementsAre(PosePair{0, 2}, PosePair{2, 4}));
  EXPECT_THAT(pose_pairs(on_a_line({0, 0, 0}), {}), ElementsAre(PosePair{0, 1}, PosePair{1, 2}));
}

TEST(PosePairs, ByFramesAllPairsStartAtEveryPose) {
  EXPECT_THAT(pose_pairs(on_a_line({0, 0, 0, 0}), {.delta = 2, .all_pairs = true}),
              ElementsAre(PosePair{0, 2}, PosePair{1, 3}));
}

TEST(PosePairs, ByPathConsecutiveOnesEndWhereThePathReachesDelta) {
  // Path 2 is first reached at pose 2, then at pose 4 (from there 1.5 + 1), then at 6.
  EXPECT_THAT(pose_pairs(on_a_line({0, 1, 2, 3.5, 4.5, 5.5, 6.5, 7}), {.delta = 2, .unit = DeltaUnit::kMetres}),
              ElementsAre(PosePair{2, 4}, PosePair{4, 6}));
}

TEST(PosePairs, ByPathCountsTheWayAndNotTheDistance) {
  EXPECT_THAT(pose_pairs(on_a_line({0, 1, 0, 1, 0}), {.delta = 2, .unit = DeltaUnit::kMetres}),
              ElementsAre(PosePair{2, 4}));
}

TEST(PosePairs, ByPathAllPairsTakeTheNearestWithinTheTolerance) {
  const PosePairSettings settings{.delta = 2, .unit = DeltaUnit::kMetres, .relative_tolerance = 0.1, .all_pairs = true};
  // From 0: 1.9 (off by 0.1) beats 2.15. From 1.9: 0.25, 1.6: nothing within 0.2. From 2.15: 1.35: nothing.
  EXPECT_THAT(pose_pairs(on_a_line({0, 1.9, 2.15, 3.5}), settings), ElementsAre(PosePair{0, 1}));
}

TEST(PosePairs, ByPathOfTwoEquallyNearTheFirstWins) {
  const PosePairSettings settings{.delta = 2, .unit = DeltaUnit::kMetres, .relative_tolerance = 0.5, .all_pairs = true};
  EXPECT_EQ(pose_pairs(on_a_line({0, 1.5, 1.5, 2.5}), settings).front(), (PosePair{0, 1}));
  EXPECT_EQ(pose_pairs(on_a_line({0, 2.5, 2.5}), settings).front(), (PosePair{0, 1}));
}

TEST(PosePairs, ByPathEqualASearchOverAllPairs) {
  std::vector<double> x{0};
  for (int i = 1; i < 200; ++i) x.push_back(x.back() + std::abs(std::sin(i * i)));
  for (const double delta : {0.3, 2.0, 17.0, 60.0, 500.0}) {
    Pairs expected;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      std::size_t best = i + 1;
      for (std::size_t j = i + 1; j < x.size(); ++j) {
        if (std::abs(x[j] - x[i] - delta) < std::abs(x[best] - x[i] - delta)) best = j;
      }
      if (std::abs(x[best] - x[i] - delta) <= 0.1 * delta) expected.push_back({i, best});
    }
    EXPECT_EQ(pose_pairs(on_a_line(x), {.delta = delta, .unit = DeltaUnit::kMetres, .all_pairs = true}), expected);
  }
}

TEST(PosePairs, ByAngleConsecutiveOnesAddUpTheStepsFromTheFirstPose) {
  const Trajectory trajectory = turned({0, 20, 5, 30, 31, 80});  // steps 20, 15, 25, 1, 49
  EXPECT_THAT(pose_pairs(trajectory, {.delta = 34, .unit = DeltaUnit::kDegrees}),
              ElementsAre(PosePair{0, 2}, PosePair{2, 5}));
}

TEST(PosePairs, ByAngleAllPairsLookAtTheDirectAngle) {
  const PosePairSettings settings{
      .delta = 30, .unit = DeltaUnit::kDegrees, .relative_tolerance = 0.1, .all_pairs = true};
  EXPECT_THAT(pose_pairs(turned({0, 20, 5, 32, 350}), settings),
              ElementsAre(PosePair{0, 3}, PosePair{1, 4}, PosePair{2, 3}));
}

TEST(PosePairs, RadiansAndDegreesAgree) {
  const Trajectory trajectory = turned({0, 20, 5, 32, 350, 10, 77, 120});
  for (const bool all_pairs : {false, true}) {
    EXPECT_EQ(
        pose_pairs(trajectory, {.delta = std::numbers::pi / 6, .unit = DeltaUnit::kRadians, .all_pairs = all_pairs}),
        pose_pairs(trajectory, {.delta = 30, .unit = DeltaUnit::kDegrees, .all_pairs = all_pairs}));
  }
}

TEST(PosePairs, AreNoneWhenNothingIsThatFarApart) {
  for (const bool all_pairs : {false, true}) {
    EXPECT_THAT(pose_pairs(on_a_line({0, 1}), {.delta = 2, .all_pairs = all_pairs}), IsEmpty());
    EXPECT_THAT(pose_pairs(on_a_line({0, 1}), {.delta = 9, .unit = DeltaUnit::kMetres, .all_pairs = all_pairs}),
                IsEmpty());
    EXPECT_THAT(pose_pairs(on_a_line({0, 1}), {.delta = 9, .unit = DeltaUnit::kDegrees, .all_pairs = all_pairs}),
                IsEmpty());
    for (const DeltaUnit unit : {DeltaUnit::kFrames, DeltaUnit::kMetres, DeltaUnit::kDegrees, DeltaUnit::kRadians}) {
      EXPECT_THAT(pose_pairs({}, {.unit = unit, .all_pairs = all_pairs}), IsEmpty());
      EXPECT_THAT(pose_pairs(on_a_line({0}), {.unit = unit, .all_pairs = all_pairs}), IsEmpty());
    }
  }
}

TEST(PosePairs, RefuseSettingsOutOfRange) {
  const Trajectory two = on_a_line({0, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(pose_pairs(two, {.delta = 0}), InvalidArgument);
  EXPECT_THROW(pose_pairs(two, {.delta = -1}), InvalidArgument);
  EXPECT_THROW(pose_pairs(two, {.delta = nan, .unit = DeltaUnit::kMetres}), InvalidArgument);
  EXPECT_THROW(pose_pairs(two, {.delta = 1.5}), InvalidArgument);
  EXPECT_THROW(pose_pairs(two, {.delta = 1e300}), InvalidArgument);
  EXPECT_THROW(pose_pairs(two, {.delta = 181, .unit = DeltaUnit::kDegrees}), InvalidArgument);
  EXPECT_THROW(pose_pairs(two, {.delta = 3.2, .unit = DeltaUnit::kRadians}), InvalidArgument);
  EXPECT_THROW(pose_pairs(two, {.relative_tolerance = -0.1}), InvalidArgument);
}

TEST(DeltaUnit, IsFoundByItsName) {
  EXPECT_EQ(delta_unit_named("f"), DeltaUnit::kFrames);
  EXPECT_EQ(delta_unit_named("m"), DeltaUnit::kMetres);
  EXPECT_EQ(delta_unit_named("d"), DeltaUnit::kDegrees);
  EXPECT_EQ(delta_unit_named("r"), DeltaUnit::kRadians);
  EXPECT_EQ(delta_unit_named("s"), std::nullopt);
  EXPECT_EQ(name_of(DeltaUnit::kDegrees), "d");
}

}  // namespace
}  // namespace trysquare
