// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/evaluate.h"

#include "trysquare/core/error.h"
#include "trysquare/synthetic/memory_scans.h"
#include "trysquare/synthetic/perturb.h"
#include "trysquare/synthetic/street_corner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace trysquare {
namespace {

using testing::HasSubstr;

SyntheticSequence street(std::size_t num_scans) {
  return simulate_street_corner({.num_scans = num_scans, .sensor = {.num_beams = 24, .num_azimuths = 300}});
}

std::vector<std::string> codes_of(const std::vector<Diagnostic>& warnings) {
  std::vector<std::string> codes;
  for (const Diagnostic& warning : warnings) codes.push_back(warning.code);
  return codes;
}

class EvaluateAStreet : public testing::Test {
 protected:
  SyntheticSequence truth = street(6);
  EvaluationSettings settings{.query_every = 5};
};

TEST_F(EvaluateAStreet, GivesEveryMetricAValueAndFindsItMeaningful) {
  const Evaluation evaluation = evaluate(truth.scans, truth.trajectory, settings);
  EXPECT_TRUE(evaluation.mpv->value && evaluation.mme->value && evaluation.mom->value && evaluation.omme->value);
  EXPECT_TRUE(evaluation.mom->follows_trajectory_error);
  EXPECT_TRUE(evaluation.verdict.meaningful);
  EXPECT_TRUE(evaluation.verdict.reasons.empty());
  EXPECT_GT(*evaluation.overlap.multi_scan_share, 0.9);
  EXPECT_TRUE(evaluation.windows.empty());
}

TEST_F(EvaluateAStreet, RanksThePerturbedTrajectoryWorse) {
  const Trajectory perturbed = perturb(truth.trajectory, {.translation_sigma_m = 0.1});
  const Evaluation good = evaluate(truth.scans, truth.trajectory, settings);
  const Evaluation bad = evaluate(truth.scans, perturbed, settings);
  EXPECT_GT(*bad.mom->value, 2 * *good.mom->value);
  EXPECT_GT(*bad.mpv->value, *good.mpv->value);
}

TEST_F(EvaluateAStreet, DoesNotDependOnWhereTheWorldHasItsOrigin) {
  Trajectory utm = truth.trajectory;
  for (Pose& pose : utm.world_from_scan) pose.translation += Eigen::Vector3d(5e5, 5e6, 100);
  const Evaluation here = evaluate(truth.scans, truth.trajectory, settings);
  const Evaluation there = evaluate(truth.scans, utm, settings);
  EXPECT_NEAR(*there.mpv->value / *here.mpv->value, 1.0, 1e-6);
  EXPECT_NEAR(*there.mom->value / *here.mom->value, 1.0, 1e-6);
}

TEST_F(EvaluateAStreet, IsBitIdenticalForEveryNumberOfThreads) {
  const Evaluation one = evaluate(truth.scans, truth.trajectory, settings, {}, {.num_threads = 1});
  for (const int num_threads : {2, 3}) {
    const Evaluation other = evaluate(truth.scans, truth.trajectory, settings, {}, {.num_threads = num_threads});
    EXPECT_EQ(*one.mpv->value, *other.mpv->value);
    EXPECT_EQ(*one.mme->value, *other.mme->value);
    EXPECT_EQ(*one.mom->value, *other.mom->value);
    EXPECT_EQ(*one.omme->value, *other.omme->value);
    EXPECT_EQ(*one.overlap.scans_per_neighborhood_mean, *other.overlap.scans_per_neighborhood_mean);
  }
}

TEST_F(EvaluateAStreet, TakesEveryNthPointAsAQuery) {
  const Evaluation evaluation = evaluate(truth.scans, truth.trajectory, settings);
  ASSERT_GT(evaluation.query_indices.size(), 2u);
  EXPECT_EQ(evaluation.query_indices[2], 10u);
  EXPECT_EQ(evaluation.mpv->num_queries, (evaluation.inputs.num_points + 4) / 5);
}

TEST_F(EvaluateAStreet, LeavesOutTheMetricsThatAreNotAskedFor) {
  settings.metrics = {Metric::kMom};
  const Evaluation evaluation = evaluate(truth.scans, truth.trajectory, settings);
  EXPECT_TRUE(evaluation.mom);
  EXPECT_FALSE(evaluation.mpv || evaluation.mme || evaluation.omme);
  EXPECT_TRUE(evaluation.overlap.multi_scan_share);
  EXPECT_TRUE(evaluation.verdict.meaningful);
}

TEST_F(EvaluateAStreet, ComparesWithAReference) {
  const Trajectory perturbed = perturb(truth.trajectory, {.translation_sigma_m = 0.1});
  const Evaluation evaluation = evaluate(truth.scans, perturbed, settings, {.reference = truth.trajectory});
  ASSERT_TRUE(evaluation.reference);
  EXPECT_EQ(evaluation.reference->rpe.count, 15u);
  double sum_of_squares = 0;  // the rotations are true, so E_ij is the difference of the two errors
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i + 1; j < 6; ++j) {
      const auto error = [&](std::size_t k) -> Eigen::Vector3d {
        return perturbed.world_from_scan[k].translation - truth.trajectory.world_from_scan[k].translation;
      };
      sum_of_squares += (error(i) - error(j)).squaredNorm();
    }
  }
  EXPECT_NEAR(evaluation.reference->rpe.rmse / std::sqrt(sum_of_squares / 15), 1.0, 1e-9);
  EXPECT_TRUE(evaluation.reference->ape);
}

TEST_F(EvaluateAStreet, SaysWhyApeIsUndefinedOnAStraightDrive) {
  SyntheticSequence straight =
      simulate_street_corner({.num_scans = 3, .turn_per_step_rad = 0, .sensor = {.num_beams = 8, .num_azimuths = 100}});
  const Evaluation evaluation =
      evaluate(straight.scans, straight.trajectory, settings, {.reference = straight.trajectory});
  EXPECT_FALSE(evaluation.reference->ape);
  EXPECT_FALSE(evaluation.reference->ape_reason.empty());
}

TEST_F(EvaluateAStreet, UsesTheGivenSubset) {
  OrthogonalSubset subset;
  subset.directions.push_back({.points_in_map = {{1, 0, -1.8}, {2, 0, -1.8}, {3, 1, -1.8}}});
  const Evaluation evaluation = evaluate(truth.scans, truth.trajectory, settings, {.subset = subset});
  ASSERT_EQ(evaluation.mom->directions.size(), 1u);
  EXPECT_EQ(evaluation.mom->directions[0].num_points, 3u);
  EXPECT_THAT(codes_of(evaluation.warnings), testing::Contains("few_directions"));
}

TEST_F(EvaluateAStreet, RefusesAReferenceOfAnotherLength) {
  Trajectory short_reference = truth.trajectory;
  short_reference.world_from_scan.pop_back();
  EXPECT_THROW(evaluate(truth.scans, truth.trajectory, settings, {.reference = short_reference}), InvalidArgument);
}

TEST(EvaluateWindows, AreOneRowEachWithTheMetricsOfTheirOwnMap) {
  SyntheticSequence truth = street(7);
  EvaluationSettings settings{.query_every = 5, .window = 3, .stride = 2};
  const Evaluation all = evaluate(truth.scans, truth.trajectory, settings, {.reference = truth.trajectory});
  ASSERT_EQ(all.windows.size(), 3u);
  EXPECT_EQ(all.windows[1].first, 2u);
  EXPECT_EQ(all.windows[1].last, 4u);
  EXPECT_EQ(all.num_scans_outside_windows, 0u);
  EXPECT_EQ(all.window_correlations.size(), 4u);

  std::vector<Scan> scans;  // the window as a sequence of its own
  Trajectory trajectory;
  for (std::size_t i = 2; i <= 4; ++i) {
    scans.push_back(truth.scans.load(i));
    trajectory.world_from_scan.push_back(truth.trajectory.world_from_scan[i]);
  }
  settings.window.reset();
  settings.stride.reset();
  const Evaluation alone = evaluate(MemoryScans(scans), trajectory, settings);
  EXPECT_EQ(*all.windows[1].mpv.value, *alone.mpv->value);
  EXPECT_EQ(*all.windows[1].mom.value, *alone.mom->value);
}

TEST(EvaluateWindows, LeaveAShortLastOneOutAndSaySo) {
  const SyntheticSequence truth = street(5);
  const Evaluation evaluation = evaluate(truth.scans, truth.trajectory, {.query_every = 9, .window = 2});
  EXPECT_EQ(evaluation.windows.size(), 2u);
  EXPECT_EQ(evaluation.num_scans_outside_windows, 1u);
  EXPECT_THAT(codes_of(evaluation.warnings), testing::Contains("incomplete_window"));
}

TEST(EvaluateWindows, SayWhereTheScansHardlyOverlap) {
  const SyntheticSequence truth = street(6);
  Trajectory torn = truth.trajectory;
  for (std::size_t i = 3; i < 6; ++i) torn.world_from_scan[i].translation.z() += 500 * static_cast<double>(i);
  const Evaluation evaluation =
      evaluate(truth.scans, torn, {.query_every = 5, .window = 3}, {.reference = truth.trajectory});
  ASSERT_EQ(evaluation.windows.size(), 2u);
  EXPECT_TRUE(evaluation.windows[0].meaningful);
  EXPECT_FALSE(evaluation.windows[1].meaningful);
  EXPECT_THAT(codes_of(evaluation.warnings), testing::Contains("isolated_windows"));
  EXPECT_EQ(evaluation.window_correlations[0].num_windows, 1u);
}

TEST(EvaluateWindows, ThatDoNotFitAreNone) {
  const SyntheticSequence truth = street(3);
  const Evaluation evaluation = evaluate(truth.scans, truth.trajectory, {.query_every = 9, .window = 5});
  EXPECT_TRUE(evaluation.windows.empty());
  EXPECT_THAT(codes_of(evaluation.warnings), testing::Contains("no_window"));
}

TEST(EvaluateWindows, AreOfTenScansWhenThereAreTwenty) {
  const SyntheticSequence truth =
      simulate_street_corner({.num_scans = 20, .sensor = {.num_beams = 8, .num_azimuths = 90}});
  const Evaluation evaluation = evaluate(truth.scans, truth.trajectory, {.query_every = 9});
  EXPECT_EQ(evaluation.windows.size(), 2u);
  EXPECT_EQ(evaluation.settings.window, 10u);
}

TEST(Evaluate, OfNoScansMeansNothingAndSaysWhy) {
  const Evaluation evaluation = evaluate(MemoryScans({}), {}, {});
  EXPECT_FALSE(evaluation.mpv->value);
  EXPECT_FALSE(evaluation.verdict.meaningful);
  EXPECT_THAT(evaluation.verdict.reasons, testing::Contains(HasSubstr("MPV is undefined: there are no query points")));
}

TEST(Evaluate, OfOneScanMeansNothingAndSaysWhy) {
  const SyntheticSequence truth = street(1);
  const Evaluation evaluation = evaluate(truth.scans, truth.trajectory, {.query_every = 5});
  EXPECT_TRUE(evaluation.mpv->value);
  EXPECT_FALSE(evaluation.verdict.meaningful);
  EXPECT_THAT(evaluation.verdict.reasons, testing::ElementsAre(HasSubstr("1 scan: a trajectory shows only where")));
}

TEST(Evaluate, OfScansThatFlyApartMeansNothing) {
  const SyntheticSequence truth = street(4);
  Trajectory apart = truth.trajectory;
  for (std::size_t i = 0; i < apart.size(); ++i) {
    apart.world_from_scan[i].translation.z() += 500 * static_cast<double>(i);
  }
  const Evaluation evaluation = evaluate(truth.scans, apart, {.query_every = 5});
  EXPECT_FALSE(evaluation.verdict.meaningful);
  EXPECT_THAT(evaluation.verdict.reasons, testing::Contains(HasSubstr("the scans hardly overlap")));
}

TEST(Evaluate, WarnsOfExactDuplicates) {
  const SyntheticSequence truth = street(2);
  const Trajectory standing{.world_from_scan = std::vector<Pose>(2)};
  const Scan scan = truth.scans.load(0);
  const Evaluation evaluation = evaluate(MemoryScans({scan, scan}), standing, {.query_every = 5});
  EXPECT_EQ(evaluation.inputs.num_duplicate_points, scan.points_in_scan.size());
  EXPECT_THAT(codes_of(evaluation.warnings), testing::Contains("duplicate_points"));
}

TEST(EvaluateMap, NeedsNoPosesAndClaimsNoOverlap) {
  const SyntheticSequence truth = street(1);
  const Evaluation evaluation = evaluate_map(truth.scans.load(0), {.query_every = 5});
  EXPECT_TRUE(evaluation.verdict.meaningful);
  EXPECT_FALSE(evaluation.overlap.multi_scan_share);
  EXPECT_TRUE(evaluation.positions_in_map.empty());
}

TEST(EvaluateMap, OfTwoPointsMeansNothing) {
  const Evaluation evaluation = evaluate_map({.points_in_scan = {{0, 0, 0}, {1, 0, 0}}}, {});
  EXPECT_FALSE(evaluation.verdict.meaningful);
  EXPECT_FALSE(evaluation.mpv->value);
  EXPECT_FALSE(evaluation.mom->value);
}

TEST(EvaluationSettingsValidation, NamesTheSettingItsValueAndItsRange) {
  try {
    EvaluationSettings{.window = 1}.validate();
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(), "window = 1 is out of range: it must be at least 2 scans");
  }
  EXPECT_THROW(EvaluationSettings{.metrics = {}}.validate(), InvalidArgument);
  EXPECT_THROW(EvaluationSettings{.radius_m = 0}.validate(), InvalidArgument);
  EXPECT_THROW(EvaluationSettings{.min_neighbors = 2}.validate(), InvalidArgument);
  EXPECT_THROW(EvaluationSettings{.query_every = 0}.validate(), InvalidArgument);
  EXPECT_THROW(EvaluationSettings{.stride = 3}.validate(), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
