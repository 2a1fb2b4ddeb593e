// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/plane_world.h"

#include "trysquare/core/error.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <vector>

namespace trysquare {
namespace {

const std::vector<Disc> kTwoDiscs{{{3, 0, 0}, {1, 0, 0}}, {{0, 5, 1}, {0, 0.6, 0.8}}};

Trajectory turning(std::size_t n) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < n; ++i) {
    const double at = static_cast<double>(i);
    trajectory.world_from_scan.push_back(
        {Eigen::AngleAxisd(0.3 * at, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(), {at, -at, 5}});
  }
  return trajectory;
}

TEST(ObserveDiscs, PointsLieOnTheirDiscUpToTheNoise) {
  const Trajectory poses = turning(4);
  const MemoryScans scans =
      observe_discs(kTwoDiscs, poses, {.points_per_disc = 5000, .disc_radius_m = 2, .point_sigma_m = 0.01});
  ASSERT_EQ(scans.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const Scan scan = scans.load(i);
    ASSERT_EQ(scan.points_in_scan.size(), 10'000u);
    for (std::size_t disc = 0; disc < 2; ++disc) {
      double sum = 0;
      double sum_of_squares = 0;
      for (std::size_t k = 0; k < 5000; ++k) {
        const Eigen::Vector3d point_in_world = poses.world_from_scan[i] * scan.points_in_scan[5000 * disc + k];
        const Eigen::Vector3d from_center = point_in_world - kTwoDiscs[disc].center_in_world;
        const double off_plane = from_center.dot(kTwoDiscs[disc].normal_in_world);
        ASSERT_LT((from_center - off_plane * kTwoDiscs[disc].normal_in_world).norm(), 2 + 1e-12);
        sum += off_plane;
        sum_of_squares += off_plane * off_plane;
      }
      EXPECT_NEAR(sum / 5000, 0, 5 * 0.01 / std::sqrt(5000));
      EXPECT_NEAR(sum_of_squares / 5000 / (0.01 * 0.01), 1, 5 * std::sqrt(2.0 / 5000));
    }
  }
}

TEST(ObserveDiscs, PointsAreUniformOnTheDisc) {
  const MemoryScans scans = observe_discs(kTwoDiscs, turning(1), {.points_per_disc = 20'000});
  const Pose pose = turning(1).world_from_scan[0];
  double sum = 0;
  const Scan scan = scans.load(0);
  for (std::size_t k = 0; k < 20'000; ++k)
    sum += (pose * scan.points_in_scan[k] - kTwoDiscs[0].center_in_world).squaredNorm();
  EXPECT_NEAR(sum / 20'000, 0.5 + 1e-4, 5 * std::sqrt(1.0 / 12 / 20'000));  // r² is uniform in [0, 1]
}

TEST(ObserveDiscs, EveryScanDrawsItsOwnPointsAndASeedRepeatsThem) {
  const Trajectory still{std::vector<Pose>(2), {}};
  const MemoryScans scans = observe_discs(kTwoDiscs, still, {.seed = 3});
  EXPECT_NE(scans.load(0).points_in_scan, scans.load(1).points_in_scan);
  EXPECT_EQ(observe_discs(kTwoDiscs, still, {.seed = 3}).load(1).points_in_scan, scans.load(1).points_in_scan);
  EXPECT_NE(observe_discs(kTwoDiscs, still, {.seed = 4}).load(1).points_in_scan, scans.load(1).points_in_scan);
}

TEST(ObserveDiscs, RefusesSettingsOutOfRangeAndNormalsThatAreNotOfLengthOne) {
  EXPECT_THROW(observe_discs(kTwoDiscs, turning(1), {.points_per_disc = 0}), InvalidArgument);
  EXPECT_THROW(observe_discs(kTwoDiscs, turning(1), {.disc_radius_m = 0}), InvalidArgument);
  EXPECT_THROW(observe_discs(kTwoDiscs, turning(1), {.point_sigma_m = -1}), InvalidArgument);
  EXPECT_THROW(observe_discs(std::vector<Disc>{{{0, 0, 0}, {0, 0, 2}}}, turning(1), {}), InvalidArgument);
}

TEST(OrthogonalDiscs, AreEquallyManyPerDirectionAndFarEnoughApart) {
  for (const std::size_t num_per_direction : {1u, 4u, 9u, 10u}) {
    const std::vector<Disc> discs = orthogonal_discs(num_per_direction, 3.2, 1);
    ASSERT_EQ(discs.size(), 3 * num_per_direction);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Disc& disc : discs) {
      sum += disc.normal_in_world;
      for (const Disc& other : discs) {
        if (&disc == &other) continue;
        EXPECT_GE((disc.center_in_world - other.center_in_world).norm(), 3.2);
      }
    }
    EXPECT_EQ(sum, Eigen::Vector3d::Constant(static_cast<double>(num_per_direction)));
  }
}

TEST(OrthogonalDiscs, DependOnTheSeed) {
  EXPECT_EQ(orthogonal_discs(9, 3.2, 1)[5].center_in_world, orthogonal_discs(9, 3.2, 1)[5].center_in_world);
  bool differs = false;
  for (std::size_t k = 0; k < 27; ++k) {
    differs |= orthogonal_discs(9, 3.2, 1)[k].center_in_world != orthogonal_discs(9, 3.2, 2)[k].center_in_world;
  }
  EXPECT_TRUE(differs);
}

TEST(OrthogonalDiscs, RefuseASpacingThatIsNotPositive) { EXPECT_THROW(orthogonal_discs(1, 0, 1), InvalidArgument); }

TEST(ObserveDiscs, ADiscMayHaveItsOwnNumberOfPoints) {
  const std::vector<Disc> discs{{{0, 0, 0}, {1, 0, 0}, 5}, {{9, 0, 0}, {1, 0, 0}}};
  const Trajectory at_origin{std::vector<Pose>(1), {}};
  const Scan scan = observe_discs(discs, at_origin, {.points_per_disc = 7}).load(0);
  ASSERT_EQ(scan.points_in_scan.size(), 12u);
  EXPECT_LT(scan.points_in_scan[4].norm(), 2);
  EXPECT_GT(scan.points_in_scan[5].norm(), 2);
  EXPECT_THROW(observe_discs(std::vector<Disc>{{{0, 0, 0}, {1, 0, 0}, 0}}, turning(1), {}), InvalidArgument);
}

TEST(RandomPlaneWorld, IsThatOfThePaper) {
  std::set<std::size_t> counts;
  std::size_t num_near_pole = 0;
  std::size_t num_more = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const std::vector<Disc> discs = random_plane_world(seed);
    counts.insert(discs.size());
    for (std::size_t k = 0; k < discs.size(); ++k) {
      EXPECT_LE(discs[k].center_in_world.cwiseAbs().maxCoeff(), 10);
      EXPECT_GE(discs[k].num_points, 94u);  // 30 π
      EXPECT_LE(discs[k].num_points, 314u);
      EXPECT_NEAR(discs[k].normal_in_world.norm(), 1, 1e-15);
      for (std::size_t j = 0; j < k; ++j) {
        EXPECT_GE((discs[k].center_in_world - discs[j].center_in_world).norm(), 3.2);
      }
      if (k < 3) {
        EXPECT_EQ(discs[k].normal_in_world, Eigen::Vector3d::Unit(static_cast<Eigen::Index>(k)));
      } else {
        ++num_more;
        num_near_pole += std::abs(discs[k].normal_in_world.z()) > std::cos(std::numbers::pi / 6) ? 1u : 0u;
      }
    }
  }
  EXPECT_EQ(counts, (std::set<std::size_t>{3, 4, 5, 6, 7, 8, 9, 10}));
  // Within 30° of a pole: a third of uniform polar angles, 13 % of directions that are uniform on the sphere.
  EXPECT_NEAR(static_cast<double>(num_near_pole) / static_cast<double>(num_more), 1.0 / 3, 0.07);
}

TEST(CounterexampleDiscs, ArePerpendicularOrNotAndBalancedOrNot) {
  using enum Counterexample;
  const auto largest_cosine = [](Counterexample which) {
    const std::vector<Disc> discs = counterexample_discs(which);
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        largest = std::max(largest, std::abs(discs[i].normal_in_world.dot(discs[j].normal_in_world)));
      }
    }
    return largest;
  };
  EXPECT_EQ(largest_cosine(kBalanced), 0);
  EXPECT_EQ(largest_cosine(kUnbalanced), 0);
  EXPECT_NEAR(largest_cosine(kNonOrthogonal), std::cos(35 * std::numbers::pi / 180), 1e-15);
  EXPECT_EQ(counterexample_discs(kBalanced)[0].num_points, counterexample_discs(kBalanced)[2].num_points);
  EXPECT_EQ(counterexample_discs(kUnbalanced)[0].num_points, 63u);   // 20 π
  EXPECT_EQ(counterexample_discs(kUnbalanced)[2].num_points, 942u);  // 300 π
}

}  // namespace
}  // namespace trysquare
