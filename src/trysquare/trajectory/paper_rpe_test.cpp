// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/paper_rpe.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/alignment.h"
#include "trysquare/trajectory/rpe.h"
#include "trysquare/trajectory/trajectory_test_examples.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trysquare {
namespace {

using test::disturbed;
using test::winding;

/// Σ over the ordered pairs in which the first pose comes first in time, from rpe().
double sum_of_squares(const Trajectory& reference, const Trajectory& estimate) {
  double sum = 0;
  for (std::size_t delta = 1; delta < reference.size(); ++delta) {
    sum += rpe(reference, estimate, {.pairs = {.delta = static_cast<double>(delta), .all_pairs = true}}).statistics.sse;
  }
  return sum;
}

Trajectory reversed(Trajectory trajectory) {
  std::reverse(trajectory.world_from_scan.begin(), trajectory.world_from_scan.end());
  return trajectory;
}

TEST(PaperRpe, OfThreePosesIsThatWorkedByHand) {
  const Trajectory reference{std::vector<Pose>(3), {}};
  Trajectory estimate = reference;
  estimate.world_from_scan[1].translation = {1, 0, 0};
  estimate.world_from_scan[2].translation = {0, 2, 0};
  EXPECT_DOUBLE_EQ(paper_rpe(reference, estimate), 2.0 * (1 + 4 + 5) / 3);
}

TEST(PaperRpe, SumsBothOrdersOfEveryPairOverTheNumberOfPoses) {
  const Trajectory reference = winding(25);
  const Trajectory estimate = disturbed(winding(25), 1.5);
  const double forward = sum_of_squares(reference, estimate);
  const double backward = sum_of_squares(reversed(reference), reversed(estimate));
  EXPECT_GT(std::abs(forward / backward - 1), 1e-6);  // with rotation errors E_ij and E_ji differ in length
  EXPECT_NEAR(paper_rpe(reference, estimate) / ((forward + backward) / 25), 1, 1e-13);
}

// Lemma 1 of the paper, with α = 1/(2(N − 1)) for ordered pairs and 1/N (docs/definitions.md#rpe).
TEST(PaperRpeProperty, SampleVarianceOfErrorsAlongOneAxisIsAFixedShareOfIt) {
  for (const int n : {2, 3, 10, 57}) {
    const Trajectory reference = winding(n);
    Trajectory estimate = reference;
    const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 2) / 3;
    std::vector<double> errors;
    for (int i = 0; i < n; ++i) {
      errors.push_back(std::sin(17.0 * i * i) + 0.1 * i);
      estimate.world_from_scan[static_cast<std::size_t>(i)].translation += errors.back() * axis;
    }
    double mean = 0;
    for (const double error : errors) mean += error / n;
    double variance = 0;
    for (const double error : errors) variance += (error - mean) * (error - mean) / (n - 1);
    EXPECT_NEAR(variance / paper_rpe(reference, estimate) * 2 * (n - 1), 1, 1e-13) << n << " poses";
  }
}

TEST(PaperRpeProperty, InvariantUnderARigidMotionOfEitherWorld) {
  const Trajectory reference = winding(25);
  const Trajectory estimate = disturbed(winding(25), 1.5);
  const Similarity motion{
      .pose = {Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix(), {1000, -20, 3}}};
  EXPECT_NEAR(paper_rpe(reference, transformed(motion, estimate)) / paper_rpe(reference, estimate), 1, 1e-11);
  EXPECT_NEAR(paper_rpe(transformed(motion, reference), estimate) / paper_rpe(reference, estimate), 1, 1e-11);
}

TEST(PaperRpe, RefusesFewerThanTwoPosesAndUnequalCounts) {
  EXPECT_THROW(paper_rpe(winding(1), winding(1)), InvalidArgument);
  EXPECT_THROW(paper_rpe(winding(3), winding(4)), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
