// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/evaluation_json.h"

#include "trysquare/report/orthogonal_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace trysquare {
namespace {

using nlohmann::json;

Evaluation example() {
  Evaluation evaluation;
  evaluation.inputs = {.num_scans = 2, .num_points = 100, .num_not_finite_points = 3, .num_origin_points = 4};
  evaluation.mpv = MetricResult{.value = 0.0025390347963358565, .num_queries = 100, .num_used = 90, .num_too_few = 10};
  evaluation.mme = MetricResult{.reason = "no query point has a value", .num_queries = 100, .num_degenerate = 100};
  OrthogonalMetricResult mom{.value = 0.25, .mean_of_means = 0.25, .sum_of_medians = 0.5};
  mom.directions.push_back({.normal_in_map = {0, 0, 1}, .num_points = 5, .num_used = 5, .mean = 0.25, .median = 0.5});
  mom.directions.push_back({.num_points = 2, .num_too_few = 2});
  evaluation.mom = mom;
  evaluation.overlap = {.num_neighborhoods = 90, .scans_per_neighborhood_mean = 1.5, .multi_scan_share = 0.5};
  evaluation.verdict = {.meaningful = false, .reasons = {"the scans hardly overlap"}};
  evaluation.positions_in_map = {{0, 0, 0}, {3, 4, 0}};
  evaluation.settings.window = 2;
  evaluation.windows.push_back({.first = 0, .last = 1, .mom = {.reason = "there are no orthogonal directions"}});
  evaluation.warnings.push_back({"camera_frame", "the poses look like those of a camera"});
  return evaluation;
}

const EvaluationFacts kFacts{.version = "1.2.3", .scans = "scans", .poses = "poses.txt", .poses_format = "kitti"};

json parsed(const Evaluation& evaluation) { return json::parse(to_json(evaluation, kFacts)); }

TEST(EvaluationJson, HasTheKeysOfTheInterface) {
  const json document = parsed(example());
  for (const char* key : {"schema", "version", "inputs", "settings", "metrics", "overlap", "rpe_estimate", "reference",
                          "windows", "verdict", "warnings", "trajectory", "world_from_map"}) {
    EXPECT_TRUE(document.contains(key)) << key;
  }
  EXPECT_EQ(document["schema"], "trysquare.evaluation/1");
  EXPECT_EQ(document["settings"]["definition"], "paper");
  EXPECT_EQ(document["settings"]["min_neighbors_orthogonal"], 4);
  EXPECT_EQ(document["trajectory"]["path_length_m"], 5.0);
}

TEST(EvaluationJson, GivesEveryDigitOfANumber) {
  EXPECT_EQ(parsed(example())["metrics"]["mpv"]["value"].get<double>(), 0.0025390347963358565);
}

TEST(EvaluationJson, SaysWhyAValueIsNull) {
  const json metrics = parsed(example())["metrics"];
  EXPECT_TRUE(metrics["mme"]["value"].is_null());
  EXPECT_EQ(metrics["mme"]["reason"], "no query point has a value");
  EXPECT_TRUE(metrics["omme"].is_null());
  EXPECT_EQ(metrics["omme_reason"], "not asked for");
  EXPECT_TRUE(metrics["mom"]["directions"][1]["mean"].is_null());
  EXPECT_TRUE(metrics["mom"]["directions"][1].contains("reason"));
  EXPECT_TRUE(metrics["mom"]["directions"][1]["normal"].is_null());
}

TEST(EvaluationJson, SaysOfAMapThatItsScansAreNotKnown) {
  Evaluation map;
  map.overlap = {.num_neighborhoods = 90, .neighbors_mean = 4.5, .line_like_share = 0.25};
  EXPECT_EQ(parsed(map)["overlap"]["reason"], "which points belong to one scan is not known");
  map.overlap = {};
  EXPECT_EQ(parsed(map)["overlap"]["reason"], "no neighborhood has enough points");
}

TEST(EvaluationJson, SaysWhyThereIsNoRpeEstimate) {
  Evaluation evaluation = example();
  evaluation.settings.metrics = {Metric::kMom};
  EXPECT_EQ(parsed(evaluation)["rpe_estimate_reason"], "not asked for");
  evaluation.settings.metrics = {Metric::kRpe};
  evaluation.positions_in_map.clear();
  EXPECT_TRUE(parsed(evaluation)["rpe_estimate"].is_null());
  EXPECT_EQ(parsed(evaluation)["rpe_estimate_reason"], "a map without poses has no trajectory");
}

TEST(EvaluationJson, GivesTheRpeEstimateInMetresAndDegrees) {
  Evaluation evaluation = example();
  evaluation.rpe_estimate.emplace();
  evaluation.rpe_estimate->status = EstimateStatus::kMeasured;
  evaluation.rpe_estimate->translation_rms_m = 0.5;
  evaluation.rpe_estimate->rotation_rms_rad = 3.14159265358979323846 / 4;
  evaluation.rpe_estimate->interval_m = {0.25, 0.75};
  const json estimate = parsed(evaluation)["rpe_estimate"];
  EXPECT_EQ(estimate["status"], "measured");
  EXPECT_EQ(estimate["translation_rms_m"], 0.5);
  EXPECT_DOUBLE_EQ(estimate["rotation_rms_deg"], 45.0);
  EXPECT_EQ(estimate["interval_m"], json::parse("[0.25, 0.75]"));
  EXPECT_TRUE(estimate["upper_bound_m"].is_null());
  EXPECT_EQ(estimate["upper_bound_m_reason"], "only a bound has one");
}

TEST(EvaluationJson, GivesTheFiguresOfEveryRuleOfTheRpeEstimate) {
  Evaluation evaluation = example();
  evaluation.rpe_estimate.emplace();
  const json nothing = parsed(evaluation)["rpe_estimate"];
  EXPECT_TRUE(nothing["observability"]["weakest_tie"].is_null());
  EXPECT_EQ(nothing["observability"]["weakest_tie_reason"], "nothing was adjusted");
  EXPECT_TRUE(nothing["least_share_of_neighbors"].is_null());
  evaluation.rpe_estimate->least_share_of_neighbors = 0.75;
  evaluation.rpe_estimate->weakest_tie = {.eigenvalue = 0.125,
                                          .limit = 0.0625,
                                          .first_pose = 3,
                                          .last_pose = 8,
                                          .direction_in_map = Eigen::Vector3d(0, 1, 0)};
  const json estimate = parsed(evaluation)["rpe_estimate"];
  EXPECT_EQ(estimate["least_share_of_neighbors"], 0.75);
  EXPECT_EQ(estimate["observability"]["weakest_tie"],
            json::parse(R"({"eigenvalue": 0.125, "limit": 0.0625, "first_pose": 3, "last_pose": 8,
                            "direction": [0, 1, 0]})"));
}

TEST(EvaluationJson, SumsTheSupportOfAllDirections) {
  const json mom = parsed(example())["metrics"]["mom"];
  EXPECT_EQ(mom["num_queries"], 7);
  EXPECT_EQ(mom["num_used"], 5);
  EXPECT_EQ(mom["num_too_few"], 2);
}

TEST(EvaluationJson, NeverWritesANanOrAnInfinity) {
  Evaluation evaluation = example();
  evaluation.mpv->value = std::nan("");
  evaluation.overlap.neighbors_mean = std::numeric_limits<double>::infinity();
  const json document = parsed(evaluation);
  EXPECT_TRUE(document["metrics"]["mpv"]["value"].is_null());
  EXPECT_TRUE(document["metrics"]["mpv"].contains("reason"));
  EXPECT_TRUE(document["overlap"]["neighbors_mean"].is_null());
}

TEST(EvaluationJson, IsTheSameBytesForTheSameEvaluation) {
  EXPECT_EQ(to_json(example(), kFacts), to_json(example(), kFacts));
}

TEST(EvaluationJson, HasTimingsOnlyWhenAskedFor) {
  EXPECT_FALSE(parsed(example()).contains("timing"));
  EvaluationFacts facts = kFacts;
  facts.wall_time_s = 1.5;
  EXPECT_EQ(json::parse(to_json(example(), facts))["timing"]["wall_s"], 1.5);
}

TEST(EvaluationJson, GivesAnglesInDegrees) {
  Evaluation evaluation = example();
  evaluation.reference.emplace();
  evaluation.reference->rpe_rotation.rmse = 0.5;
  evaluation.reference->ape_reason = "all on one line";
  const json reference = parsed(evaluation)["reference"];
  EXPECT_NEAR(reference["rpe_rotation"]["rmse"].get<double>(), 28.64788975654116, 1e-12);
  EXPECT_TRUE(reference["ape"].is_null());
  EXPECT_EQ(reference["ape_reason"], "all on one line");
}

TEST(EvaluationJson, KeepsNamesThatAreNotUtf8Readable) {
  EvaluationFacts facts = kFacts;
  facts.scans = "a\xff";
  EXPECT_EQ(json::parse(to_json(example(), facts))["inputs"]["scans"], "a\xEF\xBF\xBD");
}

TEST(OrthogonalJson, GivesTheAnglesBetweenDirections) {
  OrthogonalSubsetResult result;
  result.subset.directions = {{{0, 0, 1}, {{1, 2, 3}}}, {{0, -0.6, -0.8}, {}}};
  result.reason = "only 2 of 3";
  const json document = json::parse(to_json(result, OrthogonalSubsetSettings{}, {"1.2.3", "scans"}));
  EXPECT_EQ(document["schema"], "trysquare.orthogonal/1");
  EXPECT_EQ(document["directions"][0]["num_points"], 1);
  EXPECT_NEAR(document["angles"][0]["angle_deg"].get<double>(), 36.86989764584402, 1e-12);
  EXPECT_FALSE(document["follows_trajectory_error"].get<bool>());
}

}  // namespace
}  // namespace trysquare
