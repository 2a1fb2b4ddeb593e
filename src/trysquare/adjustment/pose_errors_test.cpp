// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/pose_errors.h"

#include "trysquare/core/error.h"
#include "trysquare/synthetic/random.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trysquare {
namespace {

const std::vector<Eigen::Vector3d> kPositions = {{0, 0, 0}, {1, 0, 0}, {2, 0.5, 0}, {3, 1, 0.25}};

std::vector<PoseError> some_errors() {
  return {{},
          {.translation_m = {0.05, -0.02, 0.01}, .rotation_rad = {0.001, 0.002, -0.001}},
          {.translation_m = {-0.03, 0.04, 0.02}, .rotation_rad = {0, -0.002, 0.003}},
          {.translation_m = {0.01, 0.01, -0.04}, .rotation_rad = {-0.001, 0, 0.001}}};
}

/// Patches in all directions whose intercepts are exactly what the errors make of them, plus a height of each patch's
/// own and noise.
std::vector<ObservedPatch> observed(const std::vector<PoseError>& errors, std::size_t num_patches, double sigma_m) {
  Random random(5);
  std::vector<ObservedPatch> patches(num_patches);
  for (ObservedPatch& patch : patches) {
    patch.center_in_map = 8 * random.normal_vector();
    patch.normal_in_map = random.unit_direction();
    const double height_m = 0.1 * random.normal();
    for (std::uint32_t i = 0; i < errors.size(); ++i) {
      const Eigen::Vector3d lever = patch.center_in_map - kPositions[i];
      const Eigen::Vector3d moved = errors[i].translation_m + errors[i].rotation_rad.cross(lever);
      patch.observations.push_back(
          {.scan = i,
           .intercept_m = height_m + patch.normal_in_map.dot(moved) + sigma_m * random.normal(),
           .variance_m2 = 1e-6 + sigma_m * sigma_m});
    }
  }
  return patches;
}

double largest_difference(const std::vector<PoseError>& a, const std::vector<PoseError>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, (a[i].translation_m - b[i].translation_m).norm());
    largest = std::max(largest, (a[i].rotation_rad - b[i].rotation_rad).norm());
  }
  return largest;
}

TEST(SolvePoseErrors, FindsTheErrorsThatMadeTheObservations) {
  const PoseErrors found = solve_pose_errors(observed(some_errors(), 200, 0), kPositions);
  EXPECT_LT(largest_difference(relative_to_first(found.of_pose, kPositions), some_errors()), 1e-7);
}

TEST(SolvePoseErrors, LooksThroughGrossOutliers) {
  std::vector<ObservedPatch> patches = observed(some_errors(), 200, 0.001);
  for (std::size_t p = 0; p < patches.size(); p += 5) patches[p].observations[p % 4].intercept_m += 0.8;
  const PoseErrors found = solve_pose_errors(patches, kPositions);
  EXPECT_LT(largest_difference(relative_to_first(found.of_pose, kPositions), some_errors()), 0.002);
  EXPECT_LT(found.weights[0][0], 0.01);
  EXPECT_GT(found.weights[1][0], 0.5);
}

/// Errors that one motion of all poses makes are none, and no solution may move the poses for them.
TEST(SolvePoseErrors, MovesThePosesAsLittleAsTheScansAllow) {
  const Eigen::Vector3d turn(0.002, -0.001, 0.003);
  std::vector<PoseError> shared;
  for (const Eigen::Vector3d& position : kPositions) {
    shared.push_back({.translation_m = Eigen::Vector3d(0.1, 0.2, -0.1) + turn.cross(position), .rotation_rad = turn});
  }
  const PoseErrors found = solve_pose_errors(observed(shared, 200, 0), kPositions);
  EXPECT_LT(largest_difference(found.of_pose, std::vector<PoseError>(4)), 1e-7);
}

TEST(SolvePoseErrors, LeavesAPoseThatNothingObservesWhereItIs) {
  std::vector<ObservedPatch> patches = observed(some_errors(), 100, 0);
  for (ObservedPatch& patch : patches) patch.observations.pop_back();
  const PoseErrors found = solve_pose_errors(patches, kPositions);
  EXPECT_EQ(found.of_pose[3].translation_m, Eigen::Vector3d::Zero());
  const std::vector<PoseError> from_first = relative_to_first(found.of_pose, kPositions);
  EXPECT_LT((from_first[2].translation_m - some_errors()[2].translation_m).norm(), 1e-6);
}

TEST(SolvePoseErrors, GivesTheSameBitsForEveryNumberOfThreads) {
  const std::vector<ObservedPatch> patches = observed(some_errors(), 150, 0.01);
  const PoseErrors one = solve_pose_errors(patches, kPositions, {.num_threads = 1});
  const PoseErrors three = solve_pose_errors(patches, kPositions, {.num_threads = 3});
  EXPECT_EQ(largest_difference(one.of_pose, three.of_pose), 0);
  EXPECT_EQ(one.residual_scale, three.residual_scale);
}

TEST(SolvePoseErrors, NeedsTwoPoses) {
  EXPECT_THROW(solve_pose_errors({}, std::vector<Eigen::Vector3d>(1)), InvalidArgument);
}

/// What the sandwich promises against what independent noise does, over many draws.
TEST(PoseErrorCovariance, PredictsTheScatterOfTheErrors) {
  const double sigma_m = 0.01;
  double squared_difference_m2 = 0;
  double predicted_m2 = 0;
  constexpr int kDraws = 40;
  Random random(9);
  const std::vector<PoseError> none(4);
  const std::vector<ObservedPatch> exact = observed(none, 150, 0);
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<ObservedPatch> patches = exact;
    for (ObservedPatch& patch : patches) {
      for (PatchObservation& each : patch.observations) {
        each.intercept_m += sigma_m * random.normal();
        each.variance_m2 = sigma_m * sigma_m;
      }
    }
    const PoseErrors found = solve_pose_errors(patches, kPositions);
    const std::vector<std::vector<PosePair>> pairs = {{{1, 2}}};
    const PoseErrorCovariance covariance = pose_error_covariance(patches, kPositions, found, 2.0, pairs);
    const std::vector<PoseError> from_first = relative_to_first(found.of_pose, kPositions);
    squared_difference_m2 += (from_first[1].translation_m - from_first[2].translation_m).squaredNorm() / kDraws;
    predicted_m2 += covariance.of_pairs[0].translation_m2 / kDraws;
  }
  EXPECT_NEAR(squared_difference_m2 / predicted_m2, 1, 0.35);
}

TEST(PoseErrorCovariance, AveragesOverAllPairsAsOverTheListOfThem) {
  const std::vector<ObservedPatch> patches = observed(some_errors(), 150, 0.01);
  const PoseErrors found = solve_pose_errors(patches, kPositions);
  const std::vector<std::vector<PosePair>> pairs = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
  const PoseErrorCovariance covariance = pose_error_covariance(patches, kPositions, found, 2.0, pairs);
  EXPECT_NEAR(covariance.all_pairs.translation_m2 / covariance.of_pairs[0].translation_m2, 1, 1e-9);
  EXPECT_NEAR(covariance.all_pairs.rotation_rad2 / covariance.of_pairs[0].rotation_rad2, 1, 1e-9);
}

TEST(WithoutError, TakesBackWhatTheErrorDid) {
  const Pose truth{.rotation = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(),
                   .translation = {1, 2, 3}};
  const PoseError error{.translation_m = {0.1, -0.2, 0.05}, .rotation_rad = {0.02, -0.01, 0.03}};
  const Eigen::AngleAxisd turn(error.rotation_rad.norm(), error.rotation_rad.normalized());
  const Pose wrong{.rotation = turn * truth.rotation, .translation = truth.translation + error.translation_m};
  const Pose back = without_error(wrong, error);
  EXPECT_LT((back.rotation - truth.rotation).norm(), 1e-12);
  EXPECT_LT((back.translation - truth.translation).norm(), 1e-12);
  const PoseError between = error_between(wrong, truth);
  EXPECT_LT((between.rotation_rad - error.rotation_rad).norm(), 1e-12);
  EXPECT_LT((between.translation_m - error.translation_m).norm(), 1e-12);
}

}  // namespace
}  // namespace trysquare
