// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/evaluation_json.h"

#include "trysquare/report/internal/json.h"
#include "trysquare/report/internal/orthogonal_settings_json.h"
#include "trysquare/report/internal/statistics_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace trysquare {
namespace {

using internal::Json;

constexpr const char* kNotAskedFor = "not asked for";
constexpr const char* kNoRpeEstimate = "this version of trysquare cannot estimate the RPE yet";
constexpr const char* kNoReference = "no reference trajectory was given";

Json text_or_null(const std::optional<std::string>& text) { return text ? Json(*text) : Json(nullptr); }

/// A map has no poses, and there points at the origin are kept: they may be real.
bool has_poses(const Evaluation& evaluation) { return !evaluation.positions_in_map.empty(); }

std::string rpe_estimate_reason(const EvaluationSettings& settings) {
  const auto& asked = settings.metrics;
  const bool is_asked_for = std::find(asked.begin(), asked.end(), Metric::kRpe) != asked.end();
  return is_asked_for ? kNoRpeEstimate : kNotAskedFor;
}

Json inputs_json(const Evaluation& evaluation, const EvaluationFacts& facts) {
  const EvaluationInputs& inputs = evaluation.inputs;
  const std::size_t num_dropped_origin_points = has_poses(evaluation) ? inputs.num_origin_points : 0;
  return {
      {"scans", facts.scans},
      {"poses", text_or_null(facts.poses)},
      {"poses_format", text_or_null(facts.poses_format)},
      {"left_handed", facts.left_handed},
      {"extrinsic", text_or_null(facts.extrinsic)},
      {"reference", text_or_null(facts.reference)},
      {"reference_extrinsic", text_or_null(facts.reference_extrinsic)},
      {"subset", text_or_null(facts.subset)},
      {"num_scans", inputs.num_scans},
      {"num_points", inputs.num_points},
      {"num_dropped_points", inputs.num_not_finite_points + inputs.num_out_of_range_points + num_dropped_origin_points},
      {"num_not_finite_points", inputs.num_not_finite_points},
      {"num_origin_points", inputs.num_origin_points},
      {"num_out_of_range_points", inputs.num_out_of_range_points},
      {"num_duplicate_points", inputs.num_duplicate_points}};
}

Json count_or_null(const std::optional<std::size_t>& count) { return count ? Json(*count) : Json(nullptr); }

Json settings_json(const Evaluation& evaluation, const EvaluationFacts& facts) {
  const EvaluationSettings& settings = evaluation.settings;
  Json metrics = Json::array();
  for (const Metric metric : settings.metrics) metrics.push_back(name_of(metric));
  Json json = {{"metrics", std::move(metrics)},
               {"definition", name_of(settings.definition)},
               {"radius_m", settings.radius_m},
               {"min_neighbors", settings.min_neighbors},
               {"min_neighbors_orthogonal", settings.min_neighbors_orthogonal},
               {"query_every", settings.query_every},
               {"min_range_m", settings.min_range_m},
               {"max_range_m", internal::number_or_null(settings.max_range_m)}};
  json["window"] = count_or_null(settings.window);
  json["stride"] = count_or_null(settings.stride);
  if (facts.subset) {
    json["orthogonal_subset"] = nullptr;
    json["orthogonal_subset_reason"] = "the subset was read from files";
  } else {
    json["orthogonal_subset"] = internal::orthogonal_settings_json(settings.orthogonal);
  }
  return json;
}

/// value, or null and the reason.
void set_value(Json& json, std::optional<double> value, const std::string& reason) {
  json["value"] = internal::number_or_null(value);
  if (json["value"].is_null()) json["reason"] = reason.empty() ? "no point is defined" : reason;
}

Json metric_json(const MetricResult& metric, const char* unit) {
  Json json;
  set_value(json, metric.value, metric.reason);
  json["unit"] = unit;
  json["num_queries"] = metric.num_queries;
  json["num_used"] = metric.num_used;
  json["num_degenerate"] = metric.num_degenerate;
  json["num_too_few"] = metric.num_too_few;
  return json;
}

Json direction_json(const OrthogonalMetricResult::Direction& direction) {
  Json json;
  const bool is_known = !direction.normal_in_map.isZero(0);
  json["normal"] = is_known ? internal::array_of(direction.normal_in_map) : Json(nullptr);
  if (!is_known) json["normal_reason"] = "the subset was given as points without normals";
  json["num_points"] = direction.num_points;
  json["num_used"] = direction.num_used;
  json["num_degenerate"] = direction.num_degenerate;
  json["num_too_few"] = direction.num_too_few;
  json["mean"] = internal::number_or_null(direction.mean);
  json["median"] = internal::number_or_null(direction.median);
  if (json["mean"].is_null() || json["median"].is_null()) {
    json["reason"] =
        fmt::format("no point of the direction is defined: {} of {} have too few neighbors, {} are degenerate",
                    direction.num_too_few, direction.num_points, direction.num_degenerate);
  }
  return json;
}

Json orthogonal_metric_json(const OrthogonalMetricResult& metric, const char* unit) {
  OrthogonalMetricResult::Direction sum;
  Json directions = Json::array();
  for (const OrthogonalMetricResult::Direction& direction : metric.directions) {
    sum.num_points += direction.num_points;
    sum.num_used += direction.num_used;
    sum.num_degenerate += direction.num_degenerate;
    sum.num_too_few += direction.num_too_few;
    directions.push_back(direction_json(direction));
  }
  Json json;
  set_value(json, metric.value, metric.reason.empty() ? "no direction is defined" : metric.reason);
  json["unit"] = unit;
  json["mean_of_means"] = internal::number_or_null(metric.mean_of_means);
  json["sum_of_medians"] = internal::number_or_null(metric.sum_of_medians);
  json["num_queries"] = sum.num_points;
  json["num_used"] = sum.num_used;
  json["num_degenerate"] = sum.num_degenerate;
  json["num_too_few"] = sum.num_too_few;
  json["directions"] = std::move(directions);
  json["follows_trajectory_error"] = metric.follows_trajectory_error;
  return json;
}

template <typename Result, typename ToJson>
void set_metric(Json& json, const std::string& name, const std::optional<Result>& metric, const char* unit,
                ToJson to_json) {
  json[name] = metric ? to_json(*metric, unit) : Json(nullptr);
  if (!metric) json[name + "_reason"] = kNotAskedFor;
}

Json metrics_json(const Evaluation& evaluation) {
  Json json;
  set_metric(json, "mme", evaluation.mme, "nats", metric_json);
  set_metric(json, "mpv", evaluation.mpv, "m2", metric_json);
  set_metric(json, "mom", evaluation.mom, "m2", orthogonal_metric_json);
  set_metric(json, "omme", evaluation.omme, "nats", orthogonal_metric_json);
  return json;
}

Json overlap_json(const Overlap& overlap) {
  Json json = {{"num_neighborhoods", overlap.num_neighborhoods},
               {"scans_per_neighborhood_mean", internal::number_or_null(overlap.scans_per_neighborhood_mean)},
               {"multi_scan_share", internal::number_or_null(overlap.multi_scan_share)},
               {"neighbors_mean", internal::number_or_null(overlap.neighbors_mean)},
               {"line_like_share", internal::number_or_null(overlap.line_like_share)}};
  const bool has_null = std::any_of(json.begin(), json.end(), [](const Json& value) { return value.is_null(); });
  const bool has_neighborhoods = overlap.num_neighborhoods > 0;  // and yet no scans in them: a map without poses
  if (has_null && has_neighborhoods) json["reason"] = "which points belong to one scan is not known";
  if (has_null && !has_neighborhoods) json["reason"] = "no neighborhood has enough points";
  return json;
}

Json reference_json(const ReferenceErrors& errors) {
  Json rpe = {{"unit", "m"}, {"relation", "trans_part"}, {"pairs", "all"}, {"num_pairs", errors.rpe.count}};
  Json rotation = {
      {"unit", "deg"}, {"relation", "angle_deg"}, {"pairs", "all"}, {"num_pairs", errors.rpe_rotation.count}};
  internal::set_statistics(rpe, errors.rpe);
  internal::set_statistics(rotation, internal::in_degrees(errors.rpe_rotation));
  Json json = {{"rpe", std::move(rpe)}, {"rpe_rotation", std::move(rotation)}};
  if (errors.ape) {
    json["ape"] = {{"unit", "m"}, {"relation", "trans_part"}, {"alignment", "se3"}, {"num_poses", errors.ape->count}};
    internal::set_statistics(json["ape"], *errors.ape);
  } else {
    json["ape"] = nullptr;
    json["ape_reason"] = errors.ape_reason;
  }
  json["paper_rpe"] = errors.paper_rpe;
  json["paper_rpe_unit"] = "m2";
  return json;
}

Json window_json(const WindowEvaluation& window, const Evaluation& evaluation) {
  Json json = {{"first", window.first}, {"last", window.last}};
  const auto set = [&json](const char* name, bool is_asked_for, const auto& metric) {
    const std::string reason = metric.reason.empty() ? "no point is defined" : metric.reason;
    internal::set_or_explain(json, name, is_asked_for ? metric.value : std::nullopt,
                             is_asked_for ? reason : std::string(kNotAskedFor));
  };
  set("mom", evaluation.mom.has_value(), window.mom);
  set("omme", evaluation.omme.has_value(), window.omme);
  set("mpv", evaluation.mpv.has_value(), window.mpv);
  set("mme", evaluation.mme.has_value(), window.mme);
  json["follows_trajectory_error"] = evaluation.mom ? Json(window.mom.follows_trajectory_error) : Json(nullptr);
  if (!evaluation.mom) json["follows_trajectory_error_reason"] = kNotAskedFor;
  internal::set_or_explain(json, "rpe_estimate_m", std::nullopt, rpe_estimate_reason(evaluation.settings));
  internal::set_or_explain(json, "rpe_m", window.rpe_translation_rms_m, kNoReference);
  json["overlap"] = overlap_json(window.overlap);
  json["meaningful"] = window.meaningful;
  return json;
}

std::string no_windows_reason(const Evaluation& evaluation) {
  const std::size_t num_scans = evaluation.inputs.num_scans;
  if (!has_poses(evaluation)) return "a map has no scans that windows could be made of";
  if (!evaluation.settings.window) {
    return fmt::format("no window was asked for, and {} scan{} are too few for the default ones", num_scans,
                       num_scans == 1 ? "" : "s");
  }
  return fmt::format("a window of {} scans does not fit into {}", *evaluation.settings.window, num_scans);
}

void set_windows(Json& json, const Evaluation& evaluation) {
  json["windows"] = Json::array();
  for (const WindowEvaluation& window : evaluation.windows) json["windows"].push_back(window_json(window, evaluation));
  if (evaluation.windows.empty()) json["windows_reason"] = no_windows_reason(evaluation);
  json["num_scans_outside_windows"] = evaluation.num_scans_outside_windows;

  json["window_correlations"] = Json::array();
  for (const WindowCorrelation& correlation : evaluation.window_correlations) {
    Json entry = {{"metric", correlation.metric},
                  {"num_windows", correlation.num_windows},
                  {"pearson", internal::number_or_null(correlation.pearson)},
                  {"spearman", internal::number_or_null(correlation.spearman)},
                  {"kendall_tau_b", internal::number_or_null(correlation.kendall_tau_b)}};
    if (entry["pearson"].is_null() || entry["spearman"].is_null() || entry["kendall_tau_b"].is_null()) {
      entry["reason"] = "fewer than three windows, or values that do not vary";
    }
    json["window_correlations"].push_back(std::move(entry));
  }
}

void set_trajectory(Json& json, const Evaluation& evaluation) {
  const auto& positions = evaluation.positions_in_map;
  if (has_poses(evaluation)) {
    double path_length_m = 0;
    Json points = Json::array();
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (i > 0) path_length_m += (positions[i] - positions[i - 1]).norm();
      points.push_back(internal::array_of(positions[i]));
    }
    json["trajectory"] = {
        {"num_poses", positions.size()}, {"path_length_m", path_length_m}, {"positions_in_map_m", std::move(points)}};
  } else {
    json["trajectory"] = nullptr;
    json["trajectory_reason"] = "no poses were given";
  }
  json["world_from_map"] = Json::array();
  for (int row = 0; row < 3; ++row) {
    Json numbers = internal::array_of(evaluation.world_from_map.rotation.row(row).transpose());
    numbers.push_back(internal::number_or_null(evaluation.world_from_map.translation(row)));
    json["world_from_map"].push_back(std::move(numbers));
  }
  json["world_from_map"].push_back({0.0, 0.0, 0.0, 1.0});
}

}  // namespace

std::string to_json(const Evaluation& evaluation, const EvaluationFacts& facts) {
  Json json = {{"schema", internal::kEvaluationSchema}, {"version", facts.version}};
  json["inputs"] = inputs_json(evaluation, facts);
  json["settings"] = settings_json(evaluation, facts);
  json["metrics"] = metrics_json(evaluation);
  json["overlap"] = overlap_json(evaluation.overlap);
  json["rpe_estimate"] = nullptr;
  json["rpe_estimate_reason"] = rpe_estimate_reason(evaluation.settings);
  json["reference"] = evaluation.reference ? reference_json(*evaluation.reference) : Json(nullptr);
  if (!evaluation.reference) {
    json["reference_reason"] = facts.reference ? "relative errors need at least two poses" : kNoReference;
  }
  set_windows(json, evaluation);
  json["warnings"] = Json::array();
  for (const Diagnostic& warning : evaluation.warnings) {
    json["warnings"].push_back({{"code", warning.code}, {"message", warning.message}});
  }
  json["verdict"] = {{"meaningful", evaluation.verdict.meaningful}, {"reasons", evaluation.verdict.reasons}};
  set_trajectory(json, evaluation);
  if (facts.wall_time_s) json["timing"] = {{"wall_s", *facts.wall_time_s}};
  return internal::dump(json);
}

}  // namespace trysquare
