// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/perturb.h"

#include "trysquare/core/error.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace trysquare {
namespace {

Trajectory turning(std::size_t n) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < n; ++i) {
    const double at = static_cast<double>(i);
    trajectory.world_from_scan.push_back(
        {Eigen::AngleAxisd(0.3 * at, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(), {at, -at, 5}});
    trajectory.stamps_ns.push_back(static_cast<std::int64_t>(i));
  }
  return trajectory;
}

TEST(Perturb, NoiseHasTheRequestedSizeOnEveryAxis) {
  constexpr std::size_t kCount = 20'000;
  const Trajectory truth = turning(kCount);
  const Trajectory noisy = perturb(truth, {.translation_sigma_m = 0.05, .rotation_sigma_rad = 0.002, .seed = 1});
  Eigen::Array3d translation = Eigen::Array3d::Zero();
  Eigen::Array3d rotation = Eigen::Array3d::Zero();
  for (std::size_t i = 0; i < kCount; ++i) {
    const Pose& pose = truth.world_from_scan[i];
    const Pose& error = noisy.world_from_scan[i];
    translation += (error.translation - pose.translation).array().square();
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(pose.rotation.transpose() * error.rotation));
    rotation += (turn.angle() * turn.axis()).array().square();
  }
  const double standard_error = std::sqrt(2.0 / kCount);  // of a variance over its value
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(translation[axis] / kCount / (0.05 * 0.05), 1, 5 * standard_error);
    EXPECT_NEAR(rotation[axis] / kCount / (0.002 * 0.002), 1, 5 * standard_error);
  }
}

TEST(Perturb, ErrorsOfNeighborsAreIndependent) {
  constexpr std::size_t kCount = 20'000;
  const Trajectory truth = turning(kCount);
  const Trajectory noisy = perturb(truth, {.translation_sigma_m = 1});
  const auto error = [&](std::size_t i) {
    return noisy.world_from_scan[i].translation - truth.world_from_scan[i].translation;
  };
  double sum = 0;
  for (std::size_t i = 1; i < kCount; ++i) sum += error(i).dot(error(i - 1));
  EXPECT_NEAR(sum / kCount, 0, 5 * std::sqrt(3.0 / kCount));
}

TEST(Perturb, ErrorsOfAWalkGrowWithTheRootOfTheNumberOfSteps) {
  constexpr std::size_t kWalks = 4000;
  double after_9 = 0;
  double after_36 = 0;
  for (std::size_t k = 0; k < kWalks; ++k) {
    const Trajectory walk = perturb(turning(37), {.translation_sigma_m = 0.1, .seed = k, .model = NoiseModel::kWalk});
    const auto error = [&](std::size_t i) {
      return Eigen::Vector3d(walk.world_from_scan[i].translation - turning(37).world_from_scan[i].translation);
    };
    after_9 += error(9).squaredNorm() / kWalks;
    after_36 += error(36).squaredNorm() / kWalks;
  }
  const double standard_error = std::sqrt(2.0 / 3 / kWalks);
  EXPECT_NEAR(after_9 / (9 * 3 * 0.01), 1, 5 * standard_error);
  EXPECT_NEAR(after_36 / (36 * 3 * 0.01), 1, 5 * standard_error);
}

TEST(Perturb, AWalkTurnsFromPoseToPoseAsWhiteNoiseTurnsAPose) {
  const Trajectory still{std::vector<Pose>(4), {}};
  PerturbationSettings settings{.rotation_sigma_rad = 0.1, .seed = 2};
  const Trajectory white = perturb(still, settings);
  settings.model = NoiseModel::kWalk;
  const Trajectory walk = perturb(still, settings);
  for (std::size_t i = 1; i < 4; ++i) {
    const Eigen::Matrix3d step = walk.world_from_scan[i - 1].rotation.transpose() * walk.world_from_scan[i].rotation;
    EXPECT_LT((step - white.world_from_scan[i].rotation).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(Perturb, AWalkStartsWithoutAnError) {
  const Trajectory walk =
      perturb(turning(3), {.translation_sigma_m = 1, .rotation_sigma_rad = 1, .model = NoiseModel::kWalk});
  EXPECT_EQ(walk.world_from_scan[0].translation, turning(3).world_from_scan[0].translation);
  EXPECT_EQ(walk.world_from_scan[0].rotation, turning(3).world_from_scan[0].rotation);
  EXPECT_NE(walk.world_from_scan[1].translation, turning(3).world_from_scan[1].translation);
}

TEST(NoiseModel, IsFoundByItsName) {
  EXPECT_EQ(noise_model_named("white"), NoiseModel::kWhite);
  EXPECT_EQ(noise_model_named("walk"), NoiseModel::kWalk);
  EXPECT_EQ(noise_model_named("brown"), std::nullopt);
}

TEST(Perturb, IsTheSameForTheSameSeedAndDiffersForAnother) {
  const PerturbationSettings settings{.translation_sigma_m = 0.1, .rotation_sigma_rad = 0.1, .seed = 4};
  PerturbationSettings other = settings;
  other.seed = 5;
  const Pose first = perturb(turning(3), settings).world_from_scan[2];
  EXPECT_EQ(perturb(turning(3), settings).world_from_scan[2].rotation, first.rotation);
  EXPECT_EQ(perturb(turning(3), settings).world_from_scan[2].translation, first.translation);
  EXPECT_EQ(perturb(turning(9), settings).world_from_scan[2].translation, first.translation);
  EXPECT_NE(perturb(turning(3), other).world_from_scan[2].translation, first.translation);
}

TEST(Perturb, WithoutNoiseChangesNothing) {
  const Trajectory same = perturb(turning(5), {});
  EXPECT_EQ(same.world_from_scan[4].rotation, turning(5).world_from_scan[4].rotation);
  EXPECT_EQ(same.world_from_scan[4].translation, turning(5).world_from_scan[4].translation);
}

TEST(Perturb, KeepsRotationsAndStamps) {
  const Trajectory noisy = perturb(turning(5), {.rotation_sigma_rad = 1});
  EXPECT_EQ(noisy.stamps_ns, turning(5).stamps_ns);
  for (const Pose& pose : noisy.world_from_scan) EXPECT_LT(rotation_error(pose.rotation), 1e-14);
}

TEST(Perturb, RefusesNegativeAndUndefinedSigmas) {
  EXPECT_THROW(perturb(turning(1), {.translation_sigma_m = -1}), InvalidArgument);
  EXPECT_THROW(perturb(turning(1), {.rotation_sigma_rad = std::numeric_limits<double>::quiet_NaN()}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
