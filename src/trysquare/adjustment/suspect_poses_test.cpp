// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/suspect_poses.h"

#include "trysquare/synthetic/random.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <vector>

namespace trysquare {
namespace {

/// A straight drive whose poses are a centimetre off, all turned by the same small rotation about the first.
struct Drive {
  std::vector<Pose> given;
  std::vector<Pose> corrected;
};

Drive drive_with_noise(std::size_t num_poses, double turn_rad) {
  Random random(3);
  const Pose turned{.rotation = Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix()};
  Drive drive;
  for (std::size_t i = 0; i < num_poses; ++i) {
    const Pose truth{.translation = {static_cast<double>(i), 0, 0}};
    Pose given = turned * truth;
    given.translation += 0.01 * random.normal_vector();
    drive.given.push_back(given);
    drive.corrected.push_back(truth);
  }
  return drive;
}

TEST(DeviationsOfPoses, NamesTheOnePoseThatIsWrong) {
  Drive drive = drive_with_noise(10, 0);
  drive.given[6].translation += Eigen::Vector3d(0, 0.1, 0);
  const std::vector<PoseDeviation> deviations = deviations_of_poses(drive.given, drive.corrected);
  for (std::size_t i = 0; i < deviations.size(); ++i) EXPECT_EQ(deviations[i].suspect, i == 6) << i;
  EXPECT_NEAR(deviations[6].error.translation_m.y(), 0.1, 0.03);
}

TEST(DeviationsOfPoses, NamesAPoseThatIsTurned) {
  Drive drive = drive_with_noise(10, 0);
  drive.given[4].rotation = Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitX()) * drive.given[4].rotation;
  EXPECT_TRUE(deviations_of_poses(drive.given, drive.corrected)[4].suspect);
}

TEST(DeviationsOfPoses, DoesNotBlamePosesForWhatAllOfThemShare) {
  const Drive drive = drive_with_noise(15, 0.05);  // 0.7 m at the far end
  for (const PoseDeviation& each : deviations_of_poses(drive.given, drive.corrected)) EXPECT_FALSE(each.suspect);
}

TEST(DeviationsOfPoses, DoesNotBlamePosesForSlowDrift) {
  Drive drive = drive_with_noise(200, 0);
  for (std::size_t i = 0; i < drive.given.size(); ++i) drive.given[i].translation.y() += 0.002 * static_cast<double>(i);
  drive.given[120].translation.z() += 0.15;
  const std::vector<PoseDeviation> deviations = deviations_of_poses(drive.given, drive.corrected);
  for (std::size_t i = 0; i < deviations.size(); ++i) EXPECT_EQ(deviations[i].suspect, i == 120) << i;
}

/// The promise of kSuspectScore. A scale from a median alone is off by a fifth with ten poses, and breaks it.
TEST(DeviationsOfPoses, HardlyEverBlamesOneOfTenGoodPosesByChance) {
  Random random(7);
  constexpr int kDraws = 400;
  int num_false = 0;
  int num_found = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<Pose> truth(10);
    std::vector<Pose> given(10);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      truth[i].translation = {static_cast<double>(i), 0, 0};
      const Eigen::Vector3d turn_rad = 0.001 * random.normal_vector();
      given[i] = {.rotation = Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()).toRotationMatrix(),
                  .translation = truth[i].translation + 0.01 * random.normal_vector()};
    }
    given[3].translation += 0.1 * random.unit_direction();
    const std::vector<PoseDeviation> deviations = deviations_of_poses(given, truth);
    for (std::size_t i = 0; i < deviations.size(); ++i) {
      if (deviations[i].suspect) ++(i == 3 ? num_found : num_false);
    }
  }
  EXPECT_LT(num_false, 0.01 * 9 * kDraws);
  EXPECT_GE(num_found, 0.99 * kDraws);
}

TEST(DeviationsOfPoses, SuspectsNobodyAmongThree) {
  Drive drive = drive_with_noise(3, 0);
  drive.given[1].translation.y() += 1;
  for (const PoseDeviation& each : deviations_of_poses(drive.given, drive.corrected)) EXPECT_FALSE(each.suspect);
}

}  // namespace
}  // namespace trysquare
