// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/ape.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/trajectory_test_examples.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trysquare {
namespace {

using test::disturbed;
using test::winding;

using std::numbers::pi;

Similarity example(double scale) {
  return {.pose = {Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix(), {100, -20, 3}},
          .scale = scale};
}

/// One pose: the reference at the origin, the estimate at (3, 0, 4) and turned by a quarter about z.
double error_of(PoseRelation relation) {
  const Trajectory reference{{Pose{}}, {}};
  const Eigen::Matrix3d quarter_turn = Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Trajectory estimate{{Pose{quarter_turn, {3, 0, 4}}}, {}};
  const TrajectoryErrors errors = ape(reference, estimate, {.relation = relation});
  EXPECT_EQ(errors.relation, relation);
  EXPECT_EQ(errors.errors.size(), 1u);
  EXPECT_TRUE(errors.pairs.empty());
  return errors.errors.front();
}

TEST(Ape, OfOnePoseIsThatWorkedByHandInEveryRelation) {
  EXPECT_DOUBLE_EQ(error_of(PoseRelation::kTranslationPart), 5);
  EXPECT_DOUBLE_EQ(error_of(PoseRelation::kPointDistance), 5);
  EXPECT_DOUBLE_EQ(error_of(PoseRelation::kRotationAngleDeg), 90);
  EXPECT_DOUBLE_EQ(error_of(PoseRelation::kRotationAngleRad), pi / 2);
  EXPECT_DOUBLE_EQ(error_of(PoseRelation::kRotationPart), 2);          // R − I has four entries ±1
  EXPECT_DOUBLE_EQ(error_of(PoseRelation::kFull), std::sqrt(4 + 25));  // and the translation of length 5
}

TEST(Ape, StatisticsAreOfTheErrors) {
  const Trajectory reference = winding(30);
  const TrajectoryErrors errors = ape(reference, disturbed(reference));
  EXPECT_EQ(errors.statistics.count, 30u);
  EXPECT_EQ(errors.statistics.rmse, error_statistics(errors.errors).rmse);
  EXPECT_EQ(errors.statistics.median, error_statistics(errors.errors).median);
}

TEST(Ape, OfARigidlyMovedCopyIsZeroAfterSe3AndNotBefore) {
  const Trajectory reference = winding(30);
  const Trajectory moved = transformed(example(1), reference);
  for (const PoseRelation relation :
       {PoseRelation::kFull, PoseRelation::kTranslationPart, PoseRelation::kRotationPart}) {
    EXPECT_LT(ape(reference, moved, {.relation = relation, .alignment = Alignment::kSe3}).statistics.max, 1e-13);
    EXPECT_LT(ape(reference, moved, {.relation = relation, .alignment = Alignment::kOrigin}).statistics.max, 1e-13);
    EXPECT_GT(ape(reference, moved, {.relation = relation}).statistics.min, 1);
  }
}

TEST(Ape, OfAScaledCopyIsZeroAfterSim3AndNotAfterSe3) {
  const Trajectory reference = winding(30);
  const Trajectory moved = transformed(example(0.3), reference);
  const TrajectoryErrors sim3 = ape(reference, moved, {.alignment = Alignment::kSim3});
  EXPECT_LT(sim3.statistics.max, 1e-12);
  EXPECT_NEAR(sim3.reference_from_estimate.scale, 1 / 0.3, 1e-13);
  EXPECT_GT(ape(reference, moved, {.alignment = Alignment::kSe3}).statistics.rmse, 1);
}

TEST(Ape, AlignsWithTheFirstPosesOnlyWhenAsked) {
  const Trajectory reference = winding(20);
  Trajectory estimate = reference;
  for (std::size_t i = 10; i < 20; ++i) estimate.world_from_scan[i].translation.z() += 5;
  EXPECT_NEAR(ape(reference, estimate, {.alignment = Alignment::kSe3, .num_poses_to_align = 10}).errors[15], 5, 1e-12);
  EXPECT_LT(ape(reference, estimate, {.alignment = Alignment::kSe3}).errors[15], 4);
}

TEST(ApeProperty, AlignedErrorsDoNotDependOnTheWorldOfTheEstimate) {
  const Trajectory reference = winding(30);
  const Trajectory estimate = disturbed(reference);
  for (const PoseRelation relation :
       {PoseRelation::kFull, PoseRelation::kTranslationPart, PoseRelation::kRotationAngleRad}) {
    for (const Alignment alignment : {Alignment::kSe3, Alignment::kSim3, Alignment::kOrigin}) {
      const double scale = alignment == Alignment::kSim3 ? 4 : 1;
      const double before = ape(reference, estimate, {.relation = relation, .alignment = alignment}).statistics.rmse;
      const Trajectory moved = transformed(example(scale), estimate);
      EXPECT_NEAR(ape(reference, moved, {.relation = relation, .alignment = alignment}).statistics.rmse / before, 1,
                  1e-12);
    }
  }
}

TEST(Ape, RefusesUnequalAndEmptyTrajectories) {
  EXPECT_THROW(ape(winding(3), winding(4)), InvalidArgument);
  EXPECT_THROW(ape({}, {}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
