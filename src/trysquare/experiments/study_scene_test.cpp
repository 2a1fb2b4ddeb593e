// SPDX-License-Identifier: Apache-2.0
#include "trysquare/experiments/study_scene.h"

#include "trysquare/core/error.h"
#include "trysquare/synthetic/memory_scans.h"
#include "trysquare/synthetic/street_corner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace trysquare {
namespace {

const Eigen::Vector3d& point_of(const StudyScene& scene, const ScanPoint& point) {
  return scene.points_in_scan[point.scan][point.index];
}

TEST(SceneOfDiscs, HasItsSubsetOnTheFirstThreeDiscsOfTheFirstScan) {
  const std::vector<Disc> discs = random_plane_world(3);
  const StudyScene scene = scene_of_discs(discs, 4, {.seed = 1}, {.num_points_per_direction = 25});
  ASSERT_EQ(scene.points_in_scan.size(), 4u);
  ASSERT_EQ(scene.subsets.size(), 1u);
  ASSERT_EQ(scene.subsets[0].directions.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(scene.subsets[0].directions[k].points.size(), 25u);
    EXPECT_EQ(scene.subsets[0].directions[k].normal_in_map, discs[k].normal_in_world);
    for (const ScanPoint& point : scene.subsets[0].directions[k].points) {
      EXPECT_EQ(point.scan, 0u);
      EXPECT_LT((point_of(scene, point) - discs[k].center_in_world).norm(), 1.1);
    }
  }
}

TEST(SceneOfDiscs, SpreadsItsQueriesOverAllScans) {
  const StudyScene scene = scene_of_discs(counterexample_discs(Counterexample::kBalanced), 5, {}, {.num_queries = 300});
  EXPECT_GE(scene.queries.size(), 300u);
  EXPECT_LE(scene.queries.size(), 350u);
  std::vector<std::size_t> per_scan(5);
  for (const ScanPoint& query : scene.queries) ++per_scan.at(query.scan);
  for (const std::size_t count : per_scan) EXPECT_NEAR(static_cast<double>(count), 60, 12);
}

TEST(SceneOfDiscs, RefusesTooLittleToSee) {
  const std::vector<Disc> discs = random_plane_world(3);
  EXPECT_THROW(scene_of_discs(std::span(discs).first(2), 4, {}), InvalidArgument);
  EXPECT_THROW(scene_of_discs(discs, 1, {}), InvalidArgument);
  EXPECT_THROW(scene_of_discs(discs, 4, {}, {.num_queries = 0}), InvalidArgument);
  EXPECT_THROW(scene_of_discs(discs, 4, {}, {.num_points_per_direction = 0}), InvalidArgument);
}

TEST(SceneOfScans, FindsThePointsOfItsSubsetsInTheScans) {
  const SyntheticSequence street = simulate_street_corner({.num_scans = 6});
  const std::vector<StudySubsetSettings> subsets = {{"", {}}, {"_paper", {.method = SubsetMethod::kPaper}}};
  const StudyScene scene =
      scene_of_scans(street.scans, street.trajectory, 1, 4, subsets, 1.0, {.num_points_per_direction = 30});
  scene.validate();
  ASSERT_EQ(scene.points_in_scan.size(), 4u);
  EXPECT_EQ(scene.points_in_scan[0], street.scans.load(1).points_in_scan);
  ASSERT_EQ(scene.subsets.size(), 2u);
  for (const StudySubset& subset : scene.subsets) {
    ASSERT_EQ(subset.directions.size(), 3u) << subset.suffix << ": " << subset.reason;
    for (const StudySubset::Direction& direction : subset.directions) {
      EXPECT_LE(direction.points.size(), 30u);
      ASSERT_GE(direction.points.size(), 6u);
      // Walls, ground: coordinates along the normal have steps, but not the spread of a scan of 100 m.
      const Pose& first = scene.true_poses.world_from_scan[0];
      for (const ScanPoint& point : direction.points) {
        const Eigen::Vector3d in_map =
            general_inverse(first) * (scene.true_poses.world_from_scan[point.scan] * point_of(scene, point));
        EXPECT_LT(std::abs(direction.normal_in_map.dot(in_map)), 60);
      }
    }
  }
  EXPECT_EQ(scene.subsets[1].suffix, "_paper");
}

TEST(SceneOfScans, RefusesScansThatAreNotThere) {
  const SyntheticSequence street = simulate_street_corner({.num_scans = 3});
  EXPECT_THROW(scene_of_scans(street.scans, street.trajectory, 1, 3, {}, 1.0), InvalidArgument);
  EXPECT_THROW(scene_of_scans(street.scans, Trajectory{}, 0, 2, {}, 1.0), InvalidArgument);
}

TEST(StudyScene, RefusesAPointThatIsNotThere) {
  StudyScene scene = scene_of_discs(random_plane_world(1), 2, {});
  scene.queries.push_back({1, static_cast<std::uint32_t>(scene.points_in_scan[1].size())});
  EXPECT_THROW(scene.validate(), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
