// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/handedness_check.h"

#include "trysquare/core/handedness.h"
#include "trysquare/synthetic/perturb.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

/// A gentle curve to the left, or straight on.
Trajectory drive(double turn_rad) {
  Trajectory trajectory;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (int i = 0; i < 10; ++i) {
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(turn_rad * i, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    trajectory.world_from_scan.push_back({rotation, position});
    position += rotation.col(0);
  }
  return trajectory;
}

TEST(CheckHandedness, NamesPosesThatAreTheMirrorImageOfTheAdjusted) {
  const Trajectory adjusted = perturb(drive(0.01), {.translation_sigma_m = 0.005, .seed = 1});
  const std::optional<Finding> found = check_handedness(with_y_negated(drive(0.01)), adjusted);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->id, "left_handed");
  EXPECT_EQ(found->severity, Severity::kError);
  EXPECT_LT(found->evidence.value().found, 0.2);
}

TEST(CheckHandedness, AcceptsPosesThatAreWrongInAnotherWay) {
  const Trajectory adjusted = drive(0.01);
  EXPECT_FALSE(check_handedness(adjusted, adjusted));
  EXPECT_FALSE(check_handedness(perturb(adjusted, {.translation_sigma_m = 0.2, .seed = 2}), adjusted));
}

TEST(CheckHandedness, SaysNothingOfADriveStraightAhead) {
  EXPECT_FALSE(check_handedness(with_y_negated(drive(0)), drive(0)));
}

}  // namespace
}  // namespace trysquare
