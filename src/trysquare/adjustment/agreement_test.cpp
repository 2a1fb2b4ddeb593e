// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/internal/agreement.h"

#include "trysquare/synthetic/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace trysquare::internal {
namespace {

/// Adds `count` patches that all of these scans agree with.
void add_patches(std::size_t count, const Eigen::Vector3d& normal, const std::vector<std::uint32_t>& scans,
                 AdjustedPoses& poses) {
  for (std::size_t i = 0; i < count; ++i) {
    ObservedPatch patch{.normal_in_map = normal};
    for (const std::uint32_t scan : scans) patch.observations.push_back({.scan = scan});
    poses.observed.push_back(patch);
    poses.errors.weights.emplace_back(scans.size(), 1.0);
  }
}

std::vector<std::uint32_t> scans_from(std::uint32_t first, std::uint32_t end) {
  std::vector<std::uint32_t> scans;
  for (std::uint32_t i = first; i < end; ++i) scans.push_back(i);
  return scans;
}

TEST(AgreementOfPoses, TiesThemAsTheNormalsSayWhereAllSeeTheSame) {
  AdjustedPoses poses;
  add_patches(60, Eigen::Vector3d::UnitZ(), scans_from(0, 6), poses);
  add_patches(30, Eigen::Vector3d::UnitY(), scans_from(0, 6), poses);
  add_patches(10, Eigen::Vector3d::UnitX(), scans_from(0, 6), poses);
  const Agreement agreement = agreement_of(poses, 6);
  EXPECT_NEAR(agreement.smallest_eigenvalue, 0.1, 1e-12);
  EXPECT_NEAR(agreement.weakest_tie->eigenvalue, 0.1, 1e-12);
}

/// Each half of a drive has planes of its own across it, and what both share lets them slide past each other.
TEST(AgreementOfPoses, FindsGroupsThatSlidePastEachOther) {
  AdjustedPoses poses;
  add_patches(60, Eigen::Vector3d::UnitZ(), scans_from(0, 20), poses);
  add_patches(30, Eigen::Vector3d::UnitY(), scans_from(0, 20), poses);
  add_patches(10, Eigen::Vector3d::UnitX(), scans_from(0, 17), poses);
  add_patches(10, Eigen::Vector3d::UnitX(), scans_from(17, 20), poses);
  const Agreement agreement = agreement_of(poses, 20);
  EXPECT_NEAR(agreement.smallest_eigenvalue, 0.1, 1e-12) << "which sees no groups";
  EXPECT_EQ(agreement.num_components, 1U);
  EXPECT_NEAR(agreement.weakest_tie->eigenvalue, 0, 1e-12);
  EXPECT_NEAR(agreement.weakest_tie->limit, 0.125 * 0.1, 1e-12);
  EXPECT_LE(agreement.weakest_tie->first_pose, 16U);
  EXPECT_GE(agreement.weakest_tie->last_pose, 17U);
  EXPECT_NEAR(std::abs(agreement.weakest_tie->direction_in_map.x()), 1, 1e-9);
}

TEST(AgreementOfPoses, HasNoTieWithoutInliers) { EXPECT_FALSE(agreement_of(AdjustedPoses{}, 12).weakest_tie); }

TEST(AgreementOfPoses, AsksNoMoreOfATieThanTheNormalsGive) {
  AdjustedPoses poses;
  add_patches(600, Eigen::Vector3d::UnitZ(), scans_from(0, 6), poses);
  add_patches(395, Eigen::Vector3d::UnitY(), scans_from(0, 6), poses);
  add_patches(5, Eigen::Vector3d::UnitX(), scans_from(0, 6), poses);
  const Agreement agreement = agreement_of(poses, 6);
  EXPECT_NEAR(agreement.weakest_tie->eigenvalue, 0.005, 1e-12);
  EXPECT_NEAR(agreement.weakest_tie->limit, 0.125 * 0.005, 1e-12);
}

/// By hand: of two groups of three, tied by one plane in ten, the slow motion is one against the other.
TEST(AgreementOfPoses, MeasuresAWeakTie) {
  AdjustedPoses poses;
  add_patches(80, Eigen::Vector3d::UnitZ(), scans_from(0, 6), poses);
  add_patches(10, Eigen::Vector3d::UnitY(), scans_from(0, 6), poses);
  add_patches(9, Eigen::Vector3d::UnitX(), scans_from(0, 3), poses);
  add_patches(9, Eigen::Vector3d::UnitX(), scans_from(3, 6), poses);
  add_patches(1, Eigen::Vector3d::UnitX(), scans_from(0, 6), poses);
  const Agreement agreement = agreement_of(poses, 6);
  EXPECT_NEAR(agreement.weakest_tie->eigenvalue, 0.01, 1e-12);
  EXPECT_EQ(agreement.weakest_tie->first_pose, 0U);
  EXPECT_EQ(agreement.weakest_tie->last_pose, 5U);
}

/// 20 · `step` poses, of which every patch sees one in each `step` in a row.
AdjustedPoses dense_poses(std::uint32_t step) {
  AdjustedPoses poses;
  Random random(1, step);
  for (std::uint32_t p = 0; p < 100 + 10 * step; ++p) {
    std::vector<std::uint32_t> scans;
    for (std::uint32_t k = 0; k < 20; ++k) scans.push_back(step * k + static_cast<std::uint32_t>(random.bits() % step));
    for (int axis = 0; axis < 3; ++axis) add_patches(1, Eigen::Vector3d::Unit(axis), scans, poses);
  }
  return poses;
}

/// Of dense scans one in three looks at a patch. Six poses in a row then share little, and eighteen do as much as six
/// do where all look.
TEST(AgreementOfPoses, LooksAtLongerRunsWhereOnlySomePosesLookAtAPatch) {
  const PoseTie tie = agreement_of(dense_poses(3), 60).weakest_tie.value();
  EXPECT_EQ(tie.last_pose - tie.first_pose, 17U);
  EXPECT_GT(tie.eigenvalue, 0.5 / 3) << "1/3 where all look";
}

/// A sensor that stands still: the run is hundreds of poses long, and a matrix of all of them would be too large.
TEST(AgreementOfPoses, CountsPosesInARowAsOneWhereScansAreVeryDense) {
  const PoseTie tie = agreement_of(dense_poses(100), 2000).weakest_tie.value();
  EXPECT_NEAR(static_cast<double>(tie.last_pose - tie.first_pose), 600, 10);
  EXPECT_GT(tie.eigenvalue, 0.5 / 3) << "1/3 where all look";
}

}  // namespace
}  // namespace trysquare::internal
