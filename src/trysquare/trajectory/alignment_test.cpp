// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/alignment.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/trajectory_test_examples.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace trysquare {
namespace {

using test::winding;

using testing::HasSubstr;

Trajectory at(const std::vector<Eigen::Vector3d>& positions) {
  Trajectory trajectory;
  for (const Eigen::Vector3d& position : positions) trajectory.world_from_scan.push_back({.translation = position});
  return trajectory;
}

Similarity example(double scale) {
  return {.pose = {Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix(), {100, -20, 3}},
          .scale = scale};
}

double largest_difference(const Trajectory& a, const Trajectory& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Pose& p = a.world_from_scan[i];
    const Pose& q = b.world_from_scan[i];
    largest = std::max({largest, (p.rotation - q.rotation).norm(), (p.translation - q.translation).norm()});
  }
  return largest;
}

TEST(Align, Se3RecoversARigidMotion) {
  const Trajectory estimate = winding(40);
  const Trajectory reference = transformed(example(1), estimate);
  const Similarity found = align(reference, estimate, Alignment::kSe3);
  EXPECT_EQ(found.scale, 1);
  EXPECT_LT(largest_difference(transformed(found, estimate), reference), 1e-13);
}

TEST(Align, Sim3RecoversTheScaleToo) {
  for (const double scale : {0.01, 0.5, 1.0, 7.0}) {
    const Trajectory estimate = winding(40);
    const Trajectory reference = transformed(example(scale), estimate);
    const Similarity found = align(reference, estimate, Alignment::kSim3);
    EXPECT_NEAR(found.scale / scale, 1, 1e-14);
    EXPECT_LT(largest_difference(transformed(found, estimate), reference), 1e-12);
  }
}

TEST(Align, ScaleOnlyTakesTheScaleOfSim3AndMovesNothingElse) {
  const Trajectory estimate = winding(40);
  const Similarity found = align(transformed(example(3), estimate), estimate, Alignment::kScale);
  EXPECT_NEAR(found.scale, 3, 1e-13);
  EXPECT_EQ(found.pose.rotation, Eigen::Matrix3d::Identity());
  EXPECT_EQ(found.pose.translation, Eigen::Vector3d::Zero());
}

TEST(Align, OriginMakesTheFirstPosesEqual) {
  const Trajectory estimate = winding(5);
  Trajectory reference = transformed(example(1), estimate);
  reference.world_from_scan[3].translation.x() += 1;
  const Trajectory moved = transformed(align(reference, estimate, Alignment::kOrigin), estimate);
  EXPECT_LT((moved.world_from_scan[0].translation - reference.world_from_scan[0].translation).norm(), 1e-13);
  EXPECT_LT((moved.world_from_scan[0].rotation - reference.world_from_scan[0].rotation).norm(), 1e-15);
}

TEST(Align, NoneIsTheIdentity) {
  const Similarity found = align(winding(3), winding(3), Alignment::kNone);
  EXPECT_EQ(found.scale, 1);
  EXPECT_EQ(found.pose.rotation, Eigen::Matrix3d::Identity());
}

TEST(Align, IsTheLeastSquaresSolution) {
  const Trajectory estimate = winding(20);
  Trajectory reference = transformed(example(2), estimate);
  for (int i = 0; i < 20; ++i)
    reference.world_from_scan[static_cast<std::size_t>(i)].translation.y() += 0.3 * std::sin(5 * i);
  const auto cost = [&](const Similarity& similarity) {
    double sum = 0;
    const Trajectory moved = transformed(similarity, estimate);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      sum += (moved.world_from_scan[i].translation - reference.world_from_scan[i].translation).squaredNorm();
    }
    return sum;
  };
  const Similarity best = align(reference, estimate, Alignment::kSim3);
  for (int k = 0; k < 3; ++k) {
    for (const double step : {-1e-4, 1e-4}) {
      const Eigen::AngleAxisd turn(step, Eigen::Vector3d::Unit(k));
      EXPECT_GT(cost({{turn * best.pose.rotation, best.pose.translation}, best.scale}), cost(best));
      EXPECT_GT(cost({{best.pose.rotation, best.pose.translation + step * Eigen::Vector3d::Unit(k)}, best.scale}),
                cost(best));
    }
  }
  EXPECT_GT(cost({best.pose, best.scale + 1e-5}), cost(best));
  EXPECT_GT(cost({best.pose, best.scale - 1e-5}), cost(best));
}

TEST(Align, GivesARotationEvenForAMirroredTrajectory) {
  const Trajectory estimate = winding(30);
  Trajectory reference = estimate;
  for (Pose& pose : reference.world_from_scan) pose.translation.y() *= -1;
  EXPECT_NEAR(align(reference, estimate, Alignment::kSe3).pose.rotation.determinant(), 1, 1e-14);
}

TEST(Align, PlanarTrajectoriesAreEnough) {
  const Trajectory estimate = at({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Trajectory reference = transformed(example(1), estimate);
  EXPECT_LT(largest_difference(transformed(align(reference, estimate, Alignment::kSe3), estimate), reference), 1e-13);
}

TEST(Align, UsesOnlyTheFirstPosesWhenAsked) {
  const Trajectory estimate = winding(20);
  Trajectory reference = transformed(example(1), estimate);
  for (std::size_t i = 10; i < 20; ++i) reference.world_from_scan[i].translation.z() += 5;
  const Trajectory moved = transformed(align(reference, estimate, Alignment::kSe3, 10), estimate);
  EXPECT_LT((moved.world_from_scan[9].translation - reference.world_from_scan[9].translation).norm(), 1e-12);
  EXPECT_NEAR((moved.world_from_scan[15].translation - reference.world_from_scan[15].translation).norm(), 5, 1e-12);
  EXPECT_EQ(align(reference, estimate, Alignment::kSe3, 99).pose.rotation,
            align(reference, estimate, Alignment::kSe3).pose.rotation);
}

TEST(Align, RefusesPositionsThatDoNotFixARotation) {
  const Trajectory two = at({{0, 0, 0}, {1, 2, 3}});
  const Trajectory equal = at({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  Trajectory line;
  for (int i = 0; i < 50; ++i)
    line.world_from_scan.push_back({.translation = Eigen::Vector3d(0.1, -0.7, 0.3) * (1.1 * i)});
  for (const Trajectory& trajectory : {two, equal, line}) {
    for (const Alignment alignment : {Alignment::kScale, Alignment::kSe3, Alignment::kSim3}) {
      try {
        align(transformed(example(1), trajectory), trajectory, alignment);
        ADD_FAILURE() << trajectory.size() << " poses, " << name_of(alignment);
      } catch (const InvalidArgument& error) {
        EXPECT_THAT(error.what(), HasSubstr("do not fix a rotation"));
      }
    }
    EXPECT_NO_THROW(align(trajectory, trajectory, Alignment::kOrigin));
  }
  EXPECT_THROW(align(winding(50), line, Alignment::kSe3), InvalidArgument);
  EXPECT_THROW(align(winding(9), winding(9), Alignment::kSe3, 2), InvalidArgument);
}

TEST(Align, AcceptsADriveThatIsNearlyStraight) {
  Trajectory estimate;
  for (int i = 0; i < 1000; ++i)
    estimate.world_from_scan.push_back({.translation = {1.0 * i, 0.02 * std::sin(0.1 * i), 0}});
  EXPECT_NO_THROW(align(transformed(example(1), estimate), estimate, Alignment::kSe3));
}

TEST(Align, RefusesUnequalEmptyAndUndefinedTrajectories) {
  EXPECT_THROW(align(winding(3), winding(4), Alignment::kNone), InvalidArgument);
  EXPECT_THROW(align({}, {}, Alignment::kNone), InvalidArgument);
  Trajectory undefined = winding(3);
  undefined.world_from_scan[1].translation.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(align(winding(3), undefined, Alignment::kNone), InvalidArgument);
  EXPECT_THROW(align(undefined, winding(3), Alignment::kNone), InvalidArgument);
}

TEST(Transformed, KeepsStampsAndRotationsFreeOfScale) {
  Trajectory trajectory = winding(3);
  trajectory.stamps_ns = {1, 2, 3};
  const Trajectory moved = transformed(example(5), trajectory);
  EXPECT_EQ(moved.stamps_ns, trajectory.stamps_ns);
  EXPECT_NEAR(moved.world_from_scan[2].rotation.determinant(), 1, 1e-14);
}

TEST(Alignment, IsFoundByItsName) {
  for (const Alignment alignment :
       {Alignment::kNone, Alignment::kOrigin, Alignment::kScale, Alignment::kSe3, Alignment::kSim3}) {
    EXPECT_EQ(alignment_named(name_of(alignment)), alignment);
  }
  EXPECT_EQ(alignment_named("sim3"), Alignment::kSim3);
  EXPECT_EQ(alignment_named("SE3"), std::nullopt);
}

}  // namespace
}  // namespace trysquare
