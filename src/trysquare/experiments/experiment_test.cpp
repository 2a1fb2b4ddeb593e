// SPDX-License-Identifier: Apache-2.0
#include "trysquare/experiments/experiment.h"

#include "trysquare/core/error.h"
#include "trysquare/synthetic/street_corner.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

ExperimentSettings small(ExperimentKind kind) {
  ExperimentSettings settings = default_experiment(kind);
  settings.num_environments = 2;
  settings.num_poses = {5};
  settings.bootstrap.num_resamples = 50;
  return settings;
}

std::vector<GroupSummary> summaries_of(const ExperimentSettings& settings) {
  const std::vector<ExperimentUnit> units = experiment_units(settings);
  std::vector<std::vector<MetricCorrelation>> correlations;
  for (const ExperimentUnit& unit : units) {
    correlations.push_back(correlations_of(settings, unit, run_unit(settings, unit)));
  }
  return summarize(settings, units, correlations);
}

double pearson_of(const GroupSummary& group, std::string_view metric) {
  for (const MetricSummary& summary : group.metrics) {
    if (summary.metric == metric) return summary.coefficients[0].mean.value();
  }
  throw InvalidArgument("no such metric");
}

/// The paper's Figure on three planes: MOM follows the trajectory error of orthogonal planes, balanced or not, MPV only
/// of balanced ones, and nothing of planes that are not orthogonal.
TEST(Counterexample, ShowsWhatThePaperSays) {
  const std::vector<GroupSummary> groups = summaries_of(small(ExperimentKind::kCounterexample));
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].group, "balanced");
  EXPECT_GE(pearson_of(groups[0], "mom"), 0.995);
  EXPECT_EQ(groups[1].group, "unbalanced");
  EXPECT_LE(pearson_of(groups[1], "mpv"), 0.8);
  EXPECT_GE(pearson_of(groups[1], "mom"), 0.99);
  EXPECT_EQ(groups[2].group, "non-orthogonal");
  EXPECT_LE(pearson_of(groups[2], "mom"), 0.85);
}

TEST(PlanesExperiment, HasMomFollowRpeInEveryWorld) {
  ExperimentSettings settings = small(ExperimentKind::kPlanes);
  settings.num_environments = 3;
  settings.num_poses = {5, 15};
  settings.num_trajectories = 60;
  for (const GroupSummary& group : summaries_of(settings)) {
    EXPECT_GE(pearson_of(group, "mom"), 0.998) << group.num_poses;
    EXPECT_LT(pearson_of(group, "mpv"), pearson_of(group, "mom")) << group.num_poses;
    EXPECT_LT(pearson_of(group, "mme"), pearson_of(group, "mom")) << group.num_poses;
  }
}

/// With rotation noise small enough for the theory, the orthogonal metrics win, as the paper says.
TEST(StreetExperiment, HasOrthogonalMetricsAheadWhileRotationErrorsAreTiny) {
  ExperimentSettings settings = small(ExperimentKind::kStreet);
  settings.num_environments = 1;
  settings.num_trajectories = 60;
  settings.rotation_sigmas_rad.resize(1);
  const std::vector<GroupSummary> groups = summaries_of(settings);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_GT(pearson_of(groups[0], "mom"), pearson_of(groups[0], "mpv"));
  EXPECT_GT(pearson_of(groups[0], "omme"), pearson_of(groups[0], "mme"));
}

TEST(TownExperiment, HasThreeTowns) {
  std::set<std::string> groups;
  for (const ExperimentUnit& unit : experiment_units(small(ExperimentKind::kTown))) groups.insert(unit.group);
  EXPECT_EQ(groups, (std::set<std::string>{"town-grid", "town-old", "town-suburb"}));
}

TEST(ExperimentUnits, AreAllCombinationsAndHaveNamesOfTheirOwn) {
  ExperimentSettings settings = default_experiment(ExperimentKind::kCounterexample);
  settings.num_environments = 4;
  settings.rotation_sigmas_rad = {0, 0.001, 0.002};
  std::set<std::string> names;
  for (const ExperimentUnit& unit : experiment_units(settings)) names.insert(unit.name());
  EXPECT_EQ(names.size(), 3u * 4 * 3 * 3);
  EXPECT_TRUE(names.contains("non-orthogonal-e03-n30"));
}

TEST(RunUnit, DependsOnItsUnitAndTheSeedOnly) {
  ExperimentSettings settings = small(ExperimentKind::kPlanes);
  settings.num_trajectories = 3;
  const std::vector<ExperimentUnit> units = experiment_units(settings);
  const MetricSamples once = run_unit(settings, units[1], {}, {.num_threads = 1});
  EXPECT_EQ(run_unit(settings, units[1], {}, {.num_threads = 3}).rows, once.rows);
  EXPECT_NE(run_unit(settings, units[0]).rows, once.rows);
  settings.num_environments = 9;  // more of them do not change this one
  EXPECT_EQ(run_unit(settings, units[1]).rows, once.rows);
  settings.seed = 1;
  EXPECT_NE(run_unit(settings, units[1]).rows, once.rows);
}

TEST(RunUnit, TakesScansThatAreAtHand) {
  const SyntheticSequence street = simulate_street_corner({.num_scans = 6});
  ExperimentSettings settings = small(ExperimentKind::kScans);
  settings.num_poses = {2, 3};
  settings.num_trajectories = 3;
  const ExperimentData data{&street.scans, &street.trajectory};
  const std::vector<ExperimentUnit> units = experiment_units(settings);
  ASSERT_EQ(units.size(), 8u);
  const MetricSamples samples = run_unit(settings, units[0], data);
  ASSERT_EQ(samples.columns.size(), 10u);
  EXPECT_EQ(samples.columns[8], "mom_paper");
  EXPECT_NE(run_unit(settings, units[1], data).rows, samples.rows);  // other scans
  EXPECT_THROW(run_unit(settings, units[0]), InvalidArgument);
  EXPECT_THROW(run_unit(settings, {.group = "kitti", .environment = 2, .num_poses = 3}, data), InvalidArgument);
}

TEST(ExperimentSettings, AreChecked) {
  const auto refuses = [](auto change) {
    ExperimentSettings settings;
    change(settings);
    EXPECT_THROW(experiment_units(settings), InvalidArgument);
  };
  refuses([](ExperimentSettings& settings) { settings.num_environments = 0; });
  refuses([](ExperimentSettings& settings) { settings.num_poses = {}; });
  refuses([](ExperimentSettings& settings) { settings.num_poses = {1, 5}; });
  refuses([](ExperimentSettings& settings) { settings.num_poses = {5, 5}; });
  refuses([](ExperimentSettings& settings) { settings.num_trajectories = 1; });
  refuses([](ExperimentSettings& settings) { settings.rotation_sigmas_rad = {}; });
  refuses([](ExperimentSettings& settings) { settings.rotation_sigmas_rad = {-1}; });
  refuses([](ExperimentSettings& settings) { settings.radius_m = 0; });
  refuses([](ExperimentSettings& settings) { settings.bootstrap.confidence = 1; });
}

}  // namespace
}  // namespace trysquare
