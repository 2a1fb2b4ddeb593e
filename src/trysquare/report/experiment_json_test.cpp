// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/experiment_json.h"

#include "trysquare/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {
namespace {

using testing::HasSubstr;

const std::vector<ExperimentUnit> kUnits = {{"planes", 0, 5, 0.2 * std::numbers::pi / 180}};

std::vector<std::vector<MetricCorrelation>> correlations() {
  MetricCorrelation mom{.metric = "mom", .num_trajectories = 10, .num_defined = 9};
  mom.coefficients[0] = {0.5, Interval{0.25, 0.75}};
  return {{mom}};
}

TEST(ExperimentJson, SaysWhyAValueIsMissing) {
  ExperimentSettings settings;
  settings.rotation_sigmas_rad = {kUnits[0].rotation_sigma_rad};
  const auto json =
      nlohmann::json::parse(to_json(settings, summarize(settings, kUnits, correlations()), {.version = "1"}));
  const auto& metric = json.at("groups").at(0).at("metrics").at(0);
  EXPECT_EQ(metric.at("pearson").at("mean"), 0.5);
  EXPECT_TRUE(metric.at("pearson").at("std").is_null());
  EXPECT_EQ(metric.at("pearson").at("reason"), "one environment has no spread");
  EXPECT_TRUE(metric.at("kendall").at("mean").is_null());
  EXPECT_EQ(metric.at("kendall").at("reason"), "undefined in every environment");
  EXPECT_EQ(json.at("settings").at("rotation_sigmas_deg").at(0), 0.2);
}

TEST(SettingsJson, DiffersWhereverResultsCouldDiffer) {
  const auto differs = [](auto change) {
    ExperimentSettings other;
    change(other);
    return settings_json(other, {}) != settings_json(ExperimentSettings{}, {});
  };
  EXPECT_FALSE(differs([](ExperimentSettings&) {}));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.kind = ExperimentKind::kCounterexample; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.num_environments = 3; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.num_poses = {5}; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.rotation_sigmas_rad = {0.1}; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.num_trajectories = 3; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.translation_sigma_m = 3; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.noise_model = NoiseModel::kWalk; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.point_sigma_m = 3; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.radius_m = 3; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.scene.num_queries = 3; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.scene.num_points_per_direction = 3; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.intervals = IntervalMethod::kFisher; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.bootstrap.confidence = 0.9; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.bootstrap.num_resamples = 30; }));
  EXPECT_TRUE(differs([](ExperimentSettings& s) { s.seed = 3; }));
}

TEST(CorrelationsCsv, LeavesCellsEmptyWhereSomethingIsUndefined) {
  EXPECT_EQ(correlations_csv(kUnits, correlations()),
            "group,environment,rotation_sigma_deg,num_poses,metric,num_defined,pearson,pearson_low,pearson_high,"
            "spearman,spearman_low,spearman_high,kendall,kendall_low,kendall_high\n"
            "planes,0,0.2,5,mom,9,0.5,0.25,0.75,,,,,,\n");
  EXPECT_THROW(correlations_csv(kUnits, {}), InvalidArgument);
}

TEST(SummaryCsv, HasALineAMetric) {
  const std::string text = summary_csv(summarize({}, kUnits, correlations()));
  EXPECT_THAT(text, HasSubstr("\nplanes,0.2,5,mom,1,0.5,,,,0.5,0.5,,,,,,,,,,,,\n"));
}

}  // namespace
}  // namespace trysquare
