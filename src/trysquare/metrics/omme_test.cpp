// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/omme.h"

#include "trysquare/metrics/metrics_test_scenes.h"
#include "trysquare/metrics/mme.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trysquare {
namespace {

OrthogonalMetricResult omme_of(const test::Scene& scene, double radius_m = 1.0,
                               Definition definition = Definition::kPaper) {
  return omme(orthogonal_statistics(PointIndex(scene.map), scene.subset, {.radius_m = radius_m, .min_neighbors = 4}),
              definition);
}

TEST(Omme, IsTheAverageOfTheMmesOfItsDirections) {
  const test::Scene scene = test::three_walls(0.02);
  const PointIndex index(scene.map);
  double sum = 0;
  for (const OrthogonalSubset::Direction& direction : scene.subset.directions) {
    sum += *mme(point_statistics(index, direction.points_in_map, {.radius_m = 1.0, .min_neighbors = 4})).value;
  }
  EXPECT_DOUBLE_EQ(*omme_of(scene).value, sum / 3);
}

TEST(Omme, OfMapMetricsIsTheSumOfTheMedians) {
  const OrthogonalMetricResult result = omme_of(test::three_walls(0.02), 1.0, Definition::kMapMetrics);
  double sum = 0;
  for (const OrthogonalMetricResult::Direction& direction : result.directions) sum += *direction.median;
  EXPECT_DOUBLE_EQ(*result.value, sum);
}

TEST(Omme, LeavesDegenerateNeighborhoodsOutAndCountsThem) {
  const OrthogonalMetricResult result = omme_of(test::three_walls(0.0));
  EXPECT_FALSE(result.value);
  EXPECT_EQ(result.directions[0].num_degenerate, result.directions[0].num_points);
  EXPECT_EQ(result.directions[0].num_used, 0u);
}

TEST(OmmeProperty, GrowsByThreeLogarithmsOfTheScale) {
  const test::Scene scene = test::three_walls(0.02);
  const test::Scene larger = test::transformed(scene, test::some_rotation(), {9, 8, 7}, 4.0);
  EXPECT_NEAR(*omme_of(larger, 4.0).value - *omme_of(scene).value, 3 * std::log(4), 1e-10);
}

}  // namespace
}  // namespace trysquare
