// SPDX-License-Identifier: Apache-2.0
// Writes one document of every kind, with every value that can be undefined both defined and undefined somewhere:
//   trysquare_schema_examples FOLDER
// Names of files: <schema>-<what it shows>.json, and the page and the figures of each evaluation.
#include "trysquare/report/comparison_json.h"
#include "trysquare/report/diagnosis_json.h"
#include "trysquare/report/evaluation_figures.h"
#include "trysquare/report/evaluation_html.h"
#include "trysquare/report/evaluation_json.h"
#include "trysquare/report/experiment_figures.h"
#include "trysquare/report/experiment_json.h"
#include "trysquare/report/orthogonal_figures.h"
#include "trysquare/report/orthogonal_json.h"
#include "trysquare/report/simulation_json.h"
#include "trysquare/report/trajectory_json.h"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace {

using namespace trysquare;

const std::string kHostile = "a<b>&\"c'\x01\xff</script><!--]]>";

MetricResult metric(double value) {
  return {.value = value, .num_queries = 100, .num_used = 90, .num_degenerate = 3, .num_too_few = 7};
}

MetricResult undefined_metric() { return {.reason = kHostile, .num_queries = 9, .num_too_few = 9}; }

OrthogonalMetricResult orthogonal_metric(double value) {
  OrthogonalMetricResult result{.value = value, .mean_of_means = value, .sum_of_medians = 3 * value};
  result.directions.push_back({.normal_in_map = {1, 0, 0}, .num_points = 5, .num_used = 5, .mean = value, .median = 2});
  result.directions.push_back({.num_points = 4, .num_used = 4, .mean = value, .median = 2});
  result.directions.push_back({.normal_in_map = {0, 0, 1}, .num_points = 3, .num_degenerate = 1, .num_too_few = 2});
  return result;
}

Overlap some_overlap() {
  return {.num_neighborhoods = 90,
          .scans_per_neighborhood_mean = 1.5,
          .multi_scan_share = 0.5,
          .neighbors_mean = 20.25,
          .line_like_share = 0.0};
}

RpeEstimate refused_estimate() {
  RpeEstimate estimate{.reasons = {kHostile, "two halves of the patches differ"}};
  estimate.by_pairs = {{.pairs = {},
                        .num_pairs = 6,
                        .status = EstimateStatus::kBound,
                        .translation_rms_m = 0.001,
                        .rotation_rms_rad = 0.001,
                        .upper_bound_m = 0.003,
                        .half_difference_m = 0.002,
                        .half_difference_rad = 0.001},
                       {.pairs = {.delta = 10}, .num_pairs = 2, .half_difference_m = 1, .half_difference_rad = 0}};
  estimate.num_patches = 12;
  estimate.num_components = 3;
  return estimate;
}

RpeEstimate measured_estimate() {
  RpeEstimate estimate{.status = EstimateStatus::kMeasured, .translation_rms_m = 0.5, .rotation_rms_rad = 0.01};
  estimate.interval_m = {0.25, 0.75};
  estimate.interval_rad = {0.005, 0.015};
  estimate.systematic_indicator_m = 0.02;
  estimate.by_pairs = {{.pairs = {},
                        .num_pairs = 6,
                        .status = EstimateStatus::kMeasured,
                        .translation_rms_m = 0.1,
                        .rotation_rms_rad = 0.001,
                        .interval_m = {{0.09, 0.11}},
                        .half_difference_m = 0.002,
                        .half_difference_rad = 0.001},
                       {.pairs = {.delta = 10, .unit = DeltaUnit::kMetres}}};
  estimate.poses = {{.sigma_m = 0.001, .num_observations = 40}, {.deviation = {.score = 9, .suspect = true}}};
  estimate.between_scans.mom_debiased_m = 0.4;
  estimate.num_patches = 500;
  estimate.observations_per_pose_min = 40;
  estimate.num_iterations = 4;
  estimate.smallest_eigenvalue = 0.02;
  estimate.weak_direction_in_map = Eigen::Vector3d(0, 1, 0);
  estimate.weakest_tie = {.eigenvalue = 0.02,
                          .limit = 0.005,
                          .first_pose = 3,
                          .last_pose = 8,
                          .direction_in_map = Eigen::Vector3d(0, 1, 0)};
  estimate.least_share_of_neighbors = 0.8;
  estimate.half_difference_m = 0.01;
  estimate.half_difference_rad = 0.0001;
  return estimate;
}

RpeEstimate bounded_estimate() {
  RpeEstimate estimate = measured_estimate();
  estimate.status = EstimateStatus::kBound;
  estimate.reasons = {"two halves of the patches differ by as much"};
  estimate.interval_m.reset();
  estimate.interval_rad.reset();
  estimate.systematic_indicator_m.reset();
  estimate.systematic_reason = "the far patches alone do not fix the poses";
  estimate.upper_bound_m = 0.02;
  estimate.weak_direction_in_map.reset();
  return estimate;
}

/// Three windows of two scans: in the second one MOM is defined, in the third the scans do not overlap at all.
Evaluation evaluation_with_windows() {
  Evaluation evaluation;
  evaluation.inputs = {.num_scans = 7, .num_points = 100, .num_not_finite_points = 3, .num_origin_points = 4};
  evaluation.mpv = metric(0.25);
  evaluation.mme = undefined_metric();
  evaluation.mom = orthogonal_metric(0.125);
  evaluation.omme = OrthogonalMetricResult{.reason = "there are no orthogonal directions"};
  evaluation.overlap = some_overlap();
  for (std::size_t i = 0; i < 3; ++i) {
    WindowEvaluation window{.first = 2 * i, .last = 2 * i + 1, .mpv = metric(0.5), .mme = undefined_metric()};
    window.mom = i == 1 ? orthogonal_metric(0.5) : OrthogonalMetricResult{.reason = kHostile};
    window.omme = i == 1 ? orthogonal_metric(-1.5) : OrthogonalMetricResult{.reason = "no direction"};
    if (i < 2) window.overlap = some_overlap();
    evaluation.windows.push_back(window);
  }
  evaluation.num_scans_outside_windows = 1;
  for (std::size_t i = 0; i < 7; ++i) {
    evaluation.positions_in_map.emplace_back(static_cast<double>(i), -0.0, 0.01 * static_cast<double>(i * i));
  }
  evaluation.rpe_estimate = refused_estimate();
  evaluation.warnings.push_back({"camera_frame", kHostile});
  evaluation.verdict = {.meaningful = false, .reasons = {kHostile, "the scans hardly overlap"}};
  return evaluation;
}

Evaluation evaluation_against_a_reference(bool has_ape) {
  Evaluation evaluation = evaluation_with_windows();
  const ErrorStatistics statistics{
      .count = 21, .rmse = 0.5, .mean = 0.4, .median = 0.375, .std = 0.3, .min = 0, .max = 1, .sse = 5.25};
  evaluation.reference = ReferenceErrors{.rpe = statistics, .rpe_rotation = statistics, .paper_rpe = 5.0};
  if (has_ape) {
    evaluation.reference->ape = statistics;
  } else {
    evaluation.reference->ape_reason = "all poses are on one line";
  }
  for (WindowEvaluation& window : evaluation.windows) window.rpe_translation_rms_m = 0.5;
  evaluation.window_correlations.push_back({"mpv", 3, 0.5, 0.25, -1.0});
  evaluation.window_correlations.push_back({.metric = "mom", .num_windows = 1});
  evaluation.rpe_estimate = has_ape ? measured_estimate() : bounded_estimate();
  evaluation.windows[0].rpe_estimate_m = 0.25;
  evaluation.verdict = {.meaningful = true, .reasons = {}};
  return evaluation;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file.exceptions(std::ios::failbit | std::ios::badbit);
  file << text;
}

void write_evaluation(const std::filesystem::path& folder, const std::string& name, const Evaluation& evaluation,
                      const EvaluationFacts& facts) {
  const std::string json = to_json(evaluation, facts);
  write(folder / ("evaluation-" + name + ".json"), json);
  write(folder / (name + ".html"), to_html(json));
  for (const Figure& figure : figures(json)) write(folder / (name + "_" + figure.file_name), figure.svg);
}

void write_evaluations(const std::filesystem::path& folder) {
  EvaluationFacts facts{.version = "1.2.3", .scans = kHostile, .poses = kHostile, .poses_format = "kitti"};
  write_evaluation(folder, "windows", evaluation_with_windows(), facts);
  facts.reference = kHostile;
  facts.subset = kHostile;
  facts.extrinsic = "calib.txt:Tr";
  facts.reference_extrinsic = "calib.txt:Tr";
  write_evaluation(folder, "reference", evaluation_against_a_reference(true), facts);
  facts.wall_time_s = 1.5;
  write_evaluation(folder, "line", evaluation_against_a_reference(false), facts);

  Evaluation nothing_asked_for = evaluation_with_windows();
  nothing_asked_for.settings.metrics = {};
  nothing_asked_for.rpe_estimate.reset();
  nothing_asked_for.mpv.reset();
  nothing_asked_for.mme.reset();
  nothing_asked_for.mom.reset();
  nothing_asked_for.omme.reset();
  write_evaluation(folder, "nothing_asked_for", nothing_asked_for, facts);

  Evaluation map;
  map.inputs = {.num_scans = 1, .num_points = 8, .num_origin_points = 2};
  map.mpv = metric(0.0025);
  map.overlap = {.num_neighborhoods = 8, .neighbors_mean = 4.0, .line_like_share = 0.25};
  map.verdict.meaningful = true;
  write_evaluation(folder, "map", map, {.version = "1.2.3", .scans = "map.ply"});
}

Comparison comparison_of_two() {
  Comparison comparison;
  comparison.settings.evaluation.window = 2;
  comparison.settings.evaluation.stride = 2;
  const Evaluation evaluation = evaluation_with_windows();
  comparison.trajectories.push_back({.name = kHostile, .evaluation = evaluation, .rpe_m = 0.5, .rpe_rad = 0.01});
  comparison.trajectories.push_back({.name = "b", .evaluation = evaluation, .rpe_m = 0.25, .rpe_rad = 0.01});
  for (ComparedTrajectory& each : comparison.trajectories) each.interval_m = Interval{0.125, 0.75};
  comparison.adjusted_from = 1;
  comparison.adjusted_agreement_m = 0.0005;
  comparison.by_metric = {{.metric = Metric::kRpe,
                           .pairs = {{.first = 0,
                                      .second = 1,
                                      .num_windows = 6,
                                      .num_first_better = 0,
                                      .mean_difference = 0.25,
                                      .interval = Interval{0.125, 0.375},
                                      .p_value = 0.03125,
                                      .p_adjusted = 0.03125,
                                      .better = 1}},
                           .ranks = {2, 1}}};
  comparison.decisive = Metric::kRpe;
  comparison.best = {1};
  comparison.verdict.meaningful = true;
  return comparison;
}

void write_comparisons(const std::filesystem::path& folder) {
  const ComparisonFacts facts{.version = "1.2.3",
                              .scans = kHostile,
                              .sources = {{.poses = "a.txt", .poses_format = "kitti", .extrinsic = "calib.txt:Tr"},
                                          {.poses = kHostile, .poses_format = "tum", .extrinsic = {}}}};
  Comparison comparison = comparison_of_two();
  write(folder / "comparison-two.json", to_json(comparison, facts));
  comparison.adjusted_from.reset();
  comparison.adjusted_agreement_m.reset();
  for (ComparedTrajectory& each : comparison.trajectories) {
    each.rpe_m.reset();
    each.rpe_rad.reset();
    each.interval_m.reset();
    each.evaluation.mom.reset();
  }
  comparison.trajectories[0].evaluation.rpe_estimate.reset();
  comparison.by_metric[0].pairs[0] = {.first = 0, .second = 1};
  comparison.by_metric[0].ranks = {1, 1};
  comparison.decisive.reset();
  comparison.best.clear();
  comparison.verdict = {.meaningful = false, .reasons = {"no two trajectories have a value in the same window"}};
  write(folder / "comparison-nothing.json", to_json(comparison, facts));
}

void write_trajectory_errors(const std::filesystem::path& folder) {
  TrajectoryErrors errors;
  errors.errors = {0.5, 0.25};
  errors.statistics = {
      .count = 2, .rmse = 0.4, .mean = 0.375, .median = 0.375, .std = 0.125, .min = 0.25, .max = 0.5, .sse = 0.3125};
  const TrajectoryErrorsFacts facts{
      .version = "1.2.3", .reference = kHostile, .estimate = "b", .num_associated = 2, .quantiles = {0.5, 0.99}};
  write(folder / "trajectory-ape.json", to_json(errors, ApeSettings{}, facts));
  write(folder / "trajectory-rpe.json", to_json(errors, RpeSettings{}, facts));
  TrajectoryErrorsFacts facts_without_errors = facts;
  facts_without_errors.reason = "all positions lie on one line";
  facts_without_errors.warnings = {{"renamed_axes", kHostile}};
  write(folder / "trajectory-undefined.json", to_json(TrajectoryErrors{}, ApeSettings{}, facts_without_errors));
}

void write_orthogonal_subsets(const std::filesystem::path& folder) {
  const OrthogonalFacts facts{.version = "1.2.3", .scans = kHostile, .radius_m = 1.0};
  OrthogonalSubsetResult result{.reason = "no planar points", .num_points = 100, .num_planar = 50, .num_clusters = 7};
  write(folder / "orthogonal-none.json", to_json(result, {}, facts));
  result.subset.directions = {{{0, 0, 1}, {{1, 2, 3}}}, {{0, 1, 0}, {}}};
  write(folder / "orthogonal-two.json", to_json(result, {}, facts));
  result.subset.directions = {{{0, 0, 1}, {{1, 2, 3}}}, {{0, 1, 0}, {}}, {{-1, 0, 0}, {}}};
  result.reason = "";
  const std::vector<OrthogonalWindow> windows = {
      {.directions = {{{0, 0, 1}, 5, {}}, {{0, 1, 0}, 4, {}}, {{1, 0, 0}, 3, {}}}, .num_points = 9, .num_planar = 8},
      {.first = 1, .last = 1, .directions = {{{0, 0, 1}, 5, 0.1}, {{0, 1, 0}, 4, {}}}, .reason = kHostile}};
  write(folder / "orthogonal-three.json", to_json(result, {}, facts, windows));
  write(folder / "orthogonal-paper.json", to_json(result, {.method = SubsetMethod::kPaper}, facts));
  write(folder / "orthogonal-map-metrics.json", to_json(result, {.method = SubsetMethod::kMapMetrics}, facts));
  write(folder / "orthogonal-nothing.json", to_json({.reason = "no points"}, {}, facts));
  write(folder / "orthogonal_picture.svg",
        orthogonal_picture(std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 2, 3}}, result.subset).svg);
}

void write_experiments(const std::filesystem::path& folder) {
  ExperimentSettings settings{.rotation_sigmas_rad = {0.001}};
  MetricSummary none{.metric = "mom_paper", .num_environments = 2, .coefficients = {}};
  MetricSummary some{.metric = "mom", .num_environments = 3, .coefficients = {}};
  some.coefficients[0] = {3, 0.5, 0.1, Interval{0.4, 0.6}, 0.4, 0.6};
  some.coefficients[1] = {1, 0.5, {}, {}, 0.5, 0.5};
  const std::vector<GroupSummary> groups = {{"planes", 5, 0.001, {some, none}}};
  write(folder / "experiment-planes.json", to_json(settings, groups, {.version = "1.2.3"}));
  settings.kind = ExperimentKind::kScans;
  write(folder / "experiment-kitti.json",
        to_json(settings, groups, {.version = "1.2.3", .scans = kHostile, .poses = kHostile}));
  MetricCorrelation mom{.metric = "mom"};
  mom.coefficients[0].value = 0.5;
  const std::vector<ExperimentUnit> units = {{"a<b>&", 0, 5, 0.001}};
  write(folder / "experiment_correlations.svg",
        correlations_figure(units, std::vector<std::vector<MetricCorrelation>>{{mom}}).svg);
  const MetricSamples samples{{"paper_rpe", "mme", "mpv", "omme", "mom"}, {{1, 2, 3, 4, 5}, {2, 3, 4, 5, 5}}};
  write(folder / "experiment_scatter.svg", scatter_figure(std::vector<ScatterRow>{{"a<b>&", samples}}).svg);
}

void write_simulations(const std::filesystem::path& folder) {
  SimulationFacts facts{.version = "1.2.3", .world = "town", .style = "suburb", .step_m = 1.0, .seed = 7};
  facts.sensor = SimulatedSensorFacts{
      .name = "hdl64", .num_beams = 64, .num_azimuths = 2000, .horizontal_fov_rad = 6.28, .max_range_m = 80};
  facts.num_scans = 2;
  facts.num_points = 30;
  facts.num_points_min = 10;
  facts.num_points_max = 20;
  write(folder / "simulation-town.json", to_json(facts));

  facts.world = "mesh";
  facts.style.reset();
  facts.step_m.reset();
  facts.mesh = kHostile;
  facts.poses = kHostile;
  write(folder / "simulation-mesh.json", to_json(facts));
  SimulationFacts planes{.version = "1.2.3", .world = "planes", .step_m = 0.1};
  planes.planes = SimulatedPlanesFacts{.num_discs = 27, .points_per_disc = 300, .disc_radius_m = 1};
  write(folder / "simulation-planes.json", to_json(planes));
}

/// Everything found, a refused estimate, a wrong frame, and too few scans.
void write_diagnoses(const std::filesystem::path& folder) {
  const DiagnosisFacts facts{
      .version = "1.2.3", .scans = kHostile, .poses = kHostile, .poses_format = "tum", .extrinsic = "calib.txt:Tr"};
  Diagnosis found{.num_scans = 2};
  found.findings = {{"time_offset", Severity::kWarning, kHostile, kHostile, Evidence{-0.05, 0.01, "s"}},
                    {"rounded_poses", Severity::kNote, kHostile, kHostile, std::nullopt}};
  found.estimate = RpeEstimate{.status = EstimateStatus::kMeasured, .translation_rms_m = 0.5, .rotation_rms_rad = 0.25};
  found.time_offset = {.offset_s = -0.05, .resolution_s = 0.01, .num_scans = 2, .costs = {{-0.05, 0.5}, {0, 0.1}}};
  found.suspects.poses = {{.scan = 1, .translation_m = 0.5, .rotation_rad = 0.25, .score = 7}};
  found.suspects.groups = {{.first = 0, .last = 1, .is_drift = true, .translation_m = 0.5, .rotation_rad = 0.25}};
  found.jumps = {{.from = 0, .translation_m = 0.5, .rotation_rad = 0.25, .limit_m = 0.125, .limit_rad = 0.125}};
  found.off_path = {{.scan = 1, .distance_m = 0.5, .limit_m = 0.25}};
  GhostWall wall{.distance_m = 0.125, .num_patches = 3, .lower_scans = {0}, .upper_scans = {1}, .adjusted_m = 0.0};
  found.ghost_walls.push_back(wall);
  wall.adjusted_m.reset();
  found.ghost_walls.push_back(wall);
  write(folder / "diagnosis-found.json", to_json(found, {}, facts));
  Diagnosis refused{.num_scans = 9, .estimate = RpeEstimate{.reasons = {kHostile}}, .suspects_reason = kHostile};
  refused.time_offset.reason = kHostile;
  write(folder / "diagnosis-refused.json", to_json(refused, {}, facts));
  Diagnosis frame{.num_scans = 9, .blame_reason = kHostile, .suspects_reason = kHostile};
  frame.time_offset.reason = kHostile;
  write(folder / "diagnosis-frame.json", to_json(frame, {}, facts));
  write(folder / "diagnosis-none.json", to_json(Diagnosis{.num_scans = 2, .reason = kHostile}, {}, facts));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  write_evaluations(argv[1]);
  write_comparisons(argv[1]);
  write_trajectory_errors(argv[1]);
  write_orthogonal_subsets(argv[1]);
  write_experiments(argv[1]);
  write_diagnoses(argv[1]);
  write_simulations(argv[1]);
  return 0;
}
