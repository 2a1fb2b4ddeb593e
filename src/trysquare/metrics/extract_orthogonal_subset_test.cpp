// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/extract_orthogonal_subset.h"

#include "trysquare/core/error.h"
#include "trysquare/metrics/metrics_test_scenes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace trysquare {
namespace {

void expect_equal(const OrthogonalSubset& a, const OrthogonalSubset& b) {
  ASSERT_EQ(a.directions.size(), b.directions.size());
  for (std::size_t i = 0; i < a.directions.size(); ++i) {
    EXPECT_EQ(a.directions[i].normal_in_map, b.directions[i].normal_in_map);
    EXPECT_EQ(a.directions[i].points_in_map, b.directions[i].points_in_map);
  }
}

TEST(ExtractOrthogonalSubset, LooksForPatchesUnlessToldOtherwise) {
  const test::Scene scene = test::three_walls(0.01, 800);
  const OrthogonalSubsetResult result = extract_orthogonal_subset(scene.map, 0.7);
  const PatchSubsetResult patches = patch_subset(scene.map, 0.7);
  ASSERT_EQ(result.subset.directions.size(), 3u);
  expect_equal(result.subset, patches.subset);
  EXPECT_EQ(result.num_points, patches.num_candidates);
  EXPECT_EQ(result.num_planar, patches.num_planar);
  EXPECT_EQ(result.num_clusters, patches.num_modes);
  EXPECT_EQ(result.planar_share(), patches.planar_share());
}

TEST(ExtractOrthogonalSubset, ClustersNormalsWhenToldSo) {
  const test::Scene scene = test::three_walls(0.01, 800);
  const OrthogonalSubsetResult paper = extract_orthogonal_subset(scene.map, 0.7, {.method = SubsetMethod::kPaper});
  const ClusterSubsetResult clusters = cluster_subset(scene.map, 0.7);
  ASSERT_EQ(paper.subset.directions.size(), 3u);
  expect_equal(paper.subset, clusters.subset);
  EXPECT_EQ(paper.num_points, clusters.num_points);
  EXPECT_EQ(paper.num_planar, clusters.num_planar);
  EXPECT_EQ(paper.num_clusters, clusters.num_clusters);
  const OrthogonalSubsetResult theirs =
      extract_orthogonal_subset(scene.map, 0.7, {.method = SubsetMethod::kMapMetrics});
  expect_equal(theirs.subset, cluster_subset(scene.map, 0.7, map_metrics_subset_settings()).subset);
}

TEST(ExtractOrthogonalSubset, LooksAtAsManyScansAsAskedFor) {
  const test::Scene scene = test::three_walls(0.01, 400, 6);
  const std::size_t points_per_scan = 1200;
  for (const SubsetMethod method : {SubsetMethod::kPaper, SubsetMethod::kMapMetrics}) {
    EXPECT_EQ(extract_orthogonal_subset(scene.map, 0.7, {.method = method}).num_points, points_per_scan);
    EXPECT_EQ(extract_orthogonal_subset(scene.map, 0.7, {.method = method, .num_scans = 4}).num_points,
              4 * points_per_scan);
  }
  expect_equal(extract_orthogonal_subset(scene.map, 0.7, {.num_scans = 2}).subset,
               patch_subset(scene.map, 0.7, {.patches = {.num_scans = 2}}).subset);
}

// A map of the scans that are looked at is all that is needed of a long sequence.
TEST(ExtractOrthogonalSubset, OfTheScansLookedAtIsThatOfTheWholeMap) {
  const test::Scene scene = test::three_walls(0.01, 400, 9);
  const OrthogonalSubsetSettings settings{.num_scans = 3};
  ASSERT_EQ(settings.scans_looked_at(9), (std::vector<std::uint32_t>{0, 4, 8}));
  RegisteredMap some{.num_scans = 3};
  for (std::size_t i = 0; i < scene.map.points_in_map.size(); ++i) {
    if (scene.map.scan_of_point[i] % 4 != 0) continue;
    some.points_in_map.push_back(scene.map.points_in_map[i]);
    some.scan_of_point.push_back(scene.map.scan_of_point[i] / 4);
  }
  expect_equal(extract_orthogonal_subset(some, 0.7, settings).subset,
               extract_orthogonal_subset(scene.map, 0.7, settings).subset);
}

TEST(ExtractOrthogonalSubset, LeavesColinearClustersToTheirMethod) {
  EXPECT_TRUE(OrthogonalSubsetSettings{.method = SubsetMethod::kPaper}.for_clusters().join_colinear);
  EXPECT_FALSE(
      (OrthogonalSubsetSettings{.method = SubsetMethod::kPaper, .join_colinear = false}).for_clusters().join_colinear);
  EXPECT_FALSE(OrthogonalSubsetSettings{.method = SubsetMethod::kMapMetrics}.for_clusters().join_colinear);
}

TEST(ExtractOrthogonalSubset, OfNothingIsEmptyByEveryMethodAndSaysWhy) {
  for (const SubsetMethod method : {SubsetMethod::kPatches, SubsetMethod::kPaper, SubsetMethod::kMapMetrics}) {
    const OrthogonalSubsetResult result = extract_orthogonal_subset({}, 1.0, {.method = method});
    EXPECT_TRUE(result.subset.directions.empty());
    EXPECT_FALSE(result.reason.empty());
    EXPECT_FALSE(result.planar_share());
    EXPECT_THROW(extract_orthogonal_subset({}, 0.0, {.method = method}), InvalidArgument);
    EXPECT_THROW(extract_orthogonal_subset({}, 1.0, {.method = method, .num_scans = 0}), InvalidArgument);
  }
}

TEST(SubsetMethod, HasANameThatIsUnderstood) {
  for (const SubsetMethod method : {SubsetMethod::kPatches, SubsetMethod::kPaper, SubsetMethod::kMapMetrics}) {
    EXPECT_EQ(subset_method_named(name_of(method)), method);
  }
  EXPECT_EQ(name_of(SubsetMethod::kMapMetrics), "map-metrics");
  EXPECT_FALSE(subset_method_named("ward"));
}

}  // namespace
}  // namespace trysquare
