// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/pose_relation.h"

#include <gtest/gtest.h>

namespace trysquare {
namespace {

constexpr PoseRelation kAll[] = {PoseRelation::kFull,
                                 PoseRelation::kTranslationPart,
                                 PoseRelation::kRotationPart,
                                 PoseRelation::kRotationAngleDeg,
                                 PoseRelation::kRotationAngleRad,
                                 PoseRelation::kPointDistance,
                                 PoseRelation::kPointDistanceErrorRatio};

TEST(PoseRelation, IsFoundByItsName) {
  for (const PoseRelation relation : kAll) EXPECT_EQ(pose_relation_named(name_of(relation)), relation);
}

TEST(PoseRelation, NamesAreSpelledAsEvoSpellsThem) {
  EXPECT_EQ(pose_relation_named("full"), PoseRelation::kFull);
  EXPECT_EQ(pose_relation_named("trans_part"), PoseRelation::kTranslationPart);
  EXPECT_EQ(pose_relation_named("rot_part"), PoseRelation::kRotationPart);
  EXPECT_EQ(pose_relation_named("angle_deg"), PoseRelation::kRotationAngleDeg);
  EXPECT_EQ(pose_relation_named("angle_rad"), PoseRelation::kRotationAngleRad);
  EXPECT_EQ(pose_relation_named("point_distance"), PoseRelation::kPointDistance);
  EXPECT_EQ(pose_relation_named("point_distance_error_ratio"), PoseRelation::kPointDistanceErrorRatio);
}

TEST(PoseRelation, UnknownNamesAreNotFound) {
  EXPECT_EQ(pose_relation_named("translation"), std::nullopt);
  EXPECT_EQ(pose_relation_named(""), std::nullopt);
}

TEST(PoseRelation, UnitsBelongToTheRelation) {
  EXPECT_EQ(unit_of(PoseRelation::kFull), "unit-less");
  EXPECT_EQ(unit_of(PoseRelation::kTranslationPart), "m");
  EXPECT_EQ(unit_of(PoseRelation::kRotationPart), "unit-less");
  EXPECT_EQ(unit_of(PoseRelation::kRotationAngleDeg), "deg");
  EXPECT_EQ(unit_of(PoseRelation::kRotationAngleRad), "rad");
  EXPECT_EQ(unit_of(PoseRelation::kPointDistance), "m");
  EXPECT_EQ(unit_of(PoseRelation::kPointDistanceErrorRatio), "%");
}

}  // namespace
}  // namespace trysquare
