// SPDX-License-Identifier: Apache-2.0
#include "trysquare/experiments/metric_study.h"

#include "trysquare/core/error.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/metrics/mme.h"
#include "trysquare/metrics/mom.h"
#include "trysquare/metrics/mpv.h"
#include "trysquare/metrics/omme.h"
#include "trysquare/metrics/orthogonal_statistics.h"
#include "trysquare/synthetic/memory_scans.h"
#include "trysquare/trajectory/all_pairs_rpe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

const MetricStudySettings kNoisy{.num_trajectories = 5,
                                 .noise = {.translation_sigma_m = 0.05, .rotation_sigma_rad = 0.001, .seed = 3}};

StudyScene balanced(std::size_t num_scans) {
  return scene_of_discs(counterexample_discs(Counterexample::kBalanced), num_scans, {.seed = 1});
}

RegisteredMap map_of(const StudyScene& scene, const Trajectory& trajectory) {
  std::vector<Scan> scans;
  for (const auto& points : scene.points_in_scan) scans.push_back({.points_in_scan = points});
  return assemble_map(MemoryScans(std::move(scans)), trajectory).map;
}

std::vector<Eigen::Vector3d> in_map(const StudyScene& scene, const Trajectory& estimate,
                                    const std::vector<ScanPoint>& points) {
  std::vector<Eigen::Vector3d> result;
  for (const ScanPoint& point : points) {
    result.push_back(general_inverse(estimate.world_from_scan[0]) *
                     (estimate.world_from_scan[point.scan] * scene.points_in_scan[point.scan][point.index]));
  }
  return result;
}

/// The metrics the long way: a map, an index, and the library's functions on it.
TEST(MetricSample, HasTheMetricsOfTheMap) {
  const StudyScene scene = balanced(4);
  const Trajectory estimate = perturb(scene.true_poses, kNoisy.noise);
  const RegisteredMap map = map_of(scene, estimate);
  const PointIndex index(map);
  const PointStatistics points = point_statistics(index, in_map(scene, estimate, scene.queries), {});
  OrthogonalSubset subset;
  for (const StudySubset::Direction& direction : scene.subsets[0].directions) {
    subset.directions.push_back({direction.normal_in_map, in_map(scene, estimate, direction.points)});
  }
  const OrthogonalStatistics statistics = orthogonal_statistics(index, subset, {.min_neighbors = 4});

  const std::vector<double> sample = metric_sample(scene, estimate, kNoisy);
  ASSERT_EQ(sample.size(), 7u);
  EXPECT_NEAR(sample[1], all_pairs_rpe(scene.true_poses, estimate).translation_m.rmse, 1e-12);
  EXPECT_NEAR(sample[0], 3 * sample[1] * sample[1], 1e-12);
  EXPECT_NEAR(sample[2], *mme(points).value, 1e-9);
  EXPECT_NEAR(sample[3] / *mpv(points).value, 1, 1e-9);
  EXPECT_NEAR(sample[4], *omme(statistics).value, 1e-9);
  EXPECT_NEAR(sample[5] / *mom(statistics).value, 1, 1e-9);
  EXPECT_NEAR(sample[6] / *mom(statistics, Definition::kMapMetrics).value, 1, 1e-9);
}

/// Lemmas 1 and 2 without their factor 1/3: RPE_rms² = 2N/(N − 1) · (sum over directions − 3σ²), docs/definitions.md.
TEST(MetricSample, HasAMomThatFollowsTheTheory) {
  const StudyScene scene = balanced(15);
  MetricStudySettings settings{.noise = {.translation_sigma_m = 0.05, .seed = 9}};
  const std::vector<double> sample = metric_sample(scene, perturb(scene.true_poses, settings.noise), settings);
  const double predicted_m2 = 2 * 15.0 / 14 * (3 * sample[5] - 3 * 0.01 * 0.01);
  EXPECT_NEAR(std::sqrt(predicted_m2) / sample[1], 1, 0.03);
}

TEST(MetricSample, IsNotANumberWhereAMetricIsUndefined) {
  StudyScene scene = balanced(2);
  scene.subsets.push_back({"_empty", {}, "nothing looked for"});
  const std::vector<double> sample = metric_sample(scene, scene.true_poses, {});
  ASSERT_EQ(sample.size(), 10u);
  EXPECT_EQ(sample[0], 0);
  EXPECT_TRUE(std::isfinite(sample[5]));
  EXPECT_TRUE(std::isnan(sample[7]));
  EXPECT_TRUE(std::isnan(sample[8]));
}

TEST(MetricSamples, AreTheSameForEveryNumberOfThreadsAndDifferFromRowToRow) {
  const StudyScene scene = balanced(3);
  const MetricSamples one = metric_samples(scene, kNoisy, {.num_threads = 1});
  const MetricSamples three = metric_samples(scene, kNoisy, {.num_threads = 3});
  ASSERT_EQ(one.rows.size(), 5u);
  EXPECT_EQ(one.rows, three.rows);
  EXPECT_NE(one.rows[0][0], one.rows[1][0]);
}

TEST(MetricSamples, NameTheirColumns) {
  const MetricSamples samples = metric_samples(balanced(2), {.num_trajectories = 1});
  EXPECT_EQ(samples.columns,
            (std::vector<std::string>{"paper_rpe", "rpe", "mme", "mpv", "omme", "mom", "mom_sum_of_medians"}));
  EXPECT_EQ(samples.column("mpv"), std::vector<double>{samples.rows[0][3]});
  EXPECT_THROW(samples.column("nothing"), InvalidArgument);
  EXPECT_EQ(metric_columns(samples.columns).front(), "mme");
}

TEST(MetricStudySettings, AreChecked) {
  EXPECT_THROW(metric_samples(balanced(2), {.num_trajectories = 0}), InvalidArgument);
  EXPECT_THROW(metric_samples(balanced(2), {.radius_m = 0}), InvalidArgument);
  EXPECT_THROW(metric_samples(balanced(2), {.noise = {.translation_sigma_m = -1}}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
