// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/rpe.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/trajectory_test_examples.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace trysquare {
namespace {

using test::disturbed;
using test::winding;

using std::numbers::pi;

constexpr PoseRelation kAllRelations[] = {PoseRelation::kFull,
                                          PoseRelation::kTranslationPart,
                                          PoseRelation::kRotationPart,
                                          PoseRelation::kRotationAngleDeg,
                                          PoseRelation::kRotationAngleRad,
                                          PoseRelation::kPointDistance};

Similarity motion(const Eigen::Vector3d& translation) {
  return {.pose = {Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix(), translation}};
}

/// The reference moves by (2, 0, 0) without turning; the estimate by (2, 0, 0) + (0, 3, 4), turning a quarter about z.
double error_of(PoseRelation relation) {
  const Trajectory reference{{Pose{}, Pose{.translation = {2, 0, 0}}}, {}};
  const Eigen::Matrix3d quarter_turn = Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Trajectory estimate{{Pose{}, Pose{quarter_turn, {2, 3, 4}}}, {}};
  const TrajectoryErrors errors = rpe(reference, estimate, {.relation = relation});
  EXPECT_EQ(errors.pairs, (std::vector<PosePair>{{0, 1}}));
  return errors.errors.at(0);
}

TEST(Rpe, OfOnePairIsThatWorkedByHandInEveryRelation) {
  EXPECT_DOUBLE_EQ(error_of(PoseRelation::kTranslationPart), 5);
  EXPECT_DOUBLE_EQ(error_of(PoseRelation::kPointDistance), std::sqrt(29) - 2);
  EXPECT_DOUBLE_EQ(error_of(PoseRelation::kRotationAngleDeg), 90);
  EXPECT_DOUBLE_EQ(error_of(PoseRelation::kRotationAngleRad), pi / 2);
  EXPECT_DOUBLE_EQ(error_of(PoseRelation::kRotationPart), 2);
  EXPECT_DOUBLE_EQ(error_of(PoseRelation::kFull), std::sqrt(4 + 25));
}

TEST(Rpe, TheRatioOfDistancesIsInPercentAndLeavesOutPairsWithoutADistance) {
  const Trajectory reference{{Pose{}, Pose{.translation = {2, 0, 0}}, Pose{.translation = {2, 0, 0}}}, {}};
  const Trajectory estimate{{Pose{}, Pose{.translation = {0, 2.5, 0}}, Pose{.translation = {9, 2.5, 0}}}, {}};
  const TrajectoryErrors errors = rpe(reference, estimate, {.relation = PoseRelation::kPointDistanceErrorRatio});
  EXPECT_EQ(errors.errors, (std::vector<double>{25}));
  EXPECT_EQ(errors.pairs, (std::vector<PosePair>{{0, 1}}));
  EXPECT_EQ(errors.num_zero_distances, 1u);
  EXPECT_EQ(errors.unit, "%");
  const Trajectory standing{{Pose{}, Pose{}}, {}};
  EXPECT_THROW(rpe(standing, standing, {.relation = PoseRelation::kPointDistanceErrorRatio}), InvalidArgument);
}

TEST(Rpe, ProjectsBothAfterTheAlignment) {
  const Trajectory reference{{Pose{}, Pose{.translation = {2, 0, 5}}}, {}};
  const Trajectory estimate{{Pose{}, Pose{.translation = {2, 1, 0}}}, {}};
  EXPECT_DOUBLE_EQ(rpe(reference, estimate, {.projection = Plane::kXy}).errors.at(0), 1);
  EXPECT_DOUBLE_EQ(rpe(reference, estimate, {.projection = Plane::kXz}).errors.at(0), 5);
}

TEST(Rpe, ComparesMotionsInTheFrameOfTheFirstPoseOfAPair) {
  // Both drive 1 m forward; the estimate faces elsewhere. Equal motions, so no error.
  const Eigen::Matrix3d left = Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Trajectory reference{{Pose{}, Pose{.translation = {1, 0, 0}}}, {}};
  const Trajectory estimate{{Pose{left, {7, 7, 7}}, Pose{left, {7, 8, 7}}}, {}};
  EXPECT_LT(rpe(reference, estimate, {.relation = PoseRelation::kFull}).statistics.max, 1e-15);
}

TEST(Rpe, HasOneErrorPerPairInTheirOrder) {
  Trajectory estimate = winding(6);
  estimate.world_from_scan[4].translation.x() += 1;  // pairs (3, 4) and (4, 5) see it
  const TrajectoryErrors errors = rpe(winding(6), estimate);
  ASSERT_EQ(errors.pairs.size(), 5u);
  EXPECT_EQ(errors.pairs[3], (PosePair{3, 4}));
  EXPECT_LT(errors.errors[2], 1e-14);
  EXPECT_NEAR(errors.errors[3], 1, 1e-14);
  EXPECT_NEAR(errors.errors[4], 1, 1e-14);
}

TEST(Rpe, TakesPairsFromTheEstimateUnlessAskedForTheReference) {
  Trajectory reference;
  for (int i = 0; i < 4; ++i) reference.world_from_scan.push_back({.translation = {1.0 * i, 0, 0}});
  Trajectory estimate = reference;
  for (Pose& pose : estimate.world_from_scan) pose.translation *= 0.5;
  RpeSettings settings{.pairs = {.delta = 1, .unit = DeltaUnit::kMetres, .all_pairs = true}};
  EXPECT_EQ(rpe(reference, estimate, settings).pairs.front(), (PosePair{0, 2}));
  settings.pairs_from_reference = true;
  EXPECT_EQ(rpe(reference, estimate, settings).pairs.front(), (PosePair{0, 1}));
}

TEST(Rpe, MeasuresPairsOnTheAlignedEstimate) {
  const Trajectory reference = winding(30);
  Trajectory estimate = transformed({.scale = 0.5}, reference);
  const RpeSettings settings{.pairs = {.delta = 4, .unit = DeltaUnit::kMetres}, .alignment = Alignment::kSim3};
  const TrajectoryErrors errors = rpe(reference, estimate, settings);
  EXPECT_EQ(errors.pairs, pose_pairs(reference, settings.pairs));
  EXPECT_LT(errors.statistics.max, 1e-12);
  EXPECT_NEAR(errors.reference_from_estimate.scale, 2, 1e-13);
}

TEST(RpeProperty, InvariantUnderARigidMotionOfEitherWorld) {
  const Trajectory reference = winding(40);
  const Trajectory estimate = disturbed(reference);
  for (const PoseRelation relation : kAllRelations) {
    const RpeSettings settings{.relation = relation, .pairs = {.delta = 3, .all_pairs = true}};
    const double before = rpe(reference, estimate, settings).statistics.rmse;
    EXPECT_NEAR(rpe(reference, transformed(motion({100, -20, 3}), estimate), settings).statistics.rmse / before, 1,
                1e-12);
    EXPECT_NEAR(rpe(transformed(motion({100, -20, 3}), reference), estimate, settings).statistics.rmse / before, 1,
                1e-12);
  }
}

// Positions of UTM size are stored to 1e-9 m, which is all that may be lost.
TEST(RpeProperty, SurvivesUtmCoordinates) {
  const Trajectory reference = winding(40);
  const Trajectory estimate = disturbed(reference);
  const double before = rpe(reference, estimate).statistics.rmse;
  const Similarity utm = motion({5e5, 5e6, 100});
  EXPECT_NEAR(rpe(transformed(utm, reference), transformed(utm, estimate)).statistics.rmse, before, 2e-9);
}

TEST(Rpe, RefusesDeltasThatMatchNoPair) {
  EXPECT_THROW(rpe(winding(5), winding(5), {.pairs = {.delta = 5}}), InvalidArgument);
  EXPECT_THROW(rpe(winding(5), winding(5), {.pairs = {.delta = 1e4, .unit = DeltaUnit::kMetres}}), InvalidArgument);
  EXPECT_THROW(rpe(winding(1), winding(1)), InvalidArgument);
}

TEST(Rpe, RefusesUnequalAndEmptyTrajectories) {
  EXPECT_THROW(rpe(winding(3), winding(4)), InvalidArgument);
  EXPECT_THROW(rpe({}, {}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
