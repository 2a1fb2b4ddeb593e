// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/comparison_json.h"

#include "trysquare/report/internal/json.h"
#include "trysquare/report/internal/rpe_estimate_json.h"

#include <fmt/format.h>

#include <cstddef>
#include <numbers>
#include <utility>

namespace trysquare {
namespace {

using internal::Json;

constexpr const char* kNotAskedFor = "not asked for";
constexpr const char* kAllRefused = "the RPE estimates of all trajectories are refused: see rpe_estimate";

Json interval_json(const Interval& interval) { return {interval.low, interval.high}; }

void set_interval(Json& json, const std::string& key, const std::optional<Interval>& interval,
                  const std::string& reason) {
  json[key] = interval ? interval_json(*interval) : Json(nullptr);
  if (!interval) json[key + "_reason"] = reason;
}

template <typename Result>
void set_metric(Json& json, const std::string& key, const std::optional<Result>& metric) {
  std::string reason = kNotAskedFor;
  if (metric) reason = metric->reason.empty() ? "no point is defined" : metric->reason;
  internal::set_or_explain(json, key, metric ? metric->value : std::nullopt, reason);
}

std::string no_rpe_reason(const ComparedTrajectory& trajectory) {
  return trajectory.evaluation.rpe_estimate ? kAllRefused : kNotAskedFor;
}

Json trajectory_json(const ComparedTrajectory& trajectory, const ComparisonFacts::Source& source) {
  const Evaluation& evaluation = trajectory.evaluation;
  Json json = {{"name", trajectory.name}, {"poses", source.poses}, {"poses_format", source.poses_format}};
  json["extrinsic"] = source.extrinsic ? Json(*source.extrinsic) : Json(nullptr);
  const std::string no_rpe = no_rpe_reason(trajectory);
  const auto degrees = trajectory.rpe_rad ? std::optional(*trajectory.rpe_rad * 180 / std::numbers::pi) : std::nullopt;
  internal::set_or_explain(json, "rpe_m", trajectory.rpe_m, no_rpe);
  set_interval(json, "interval_m", trajectory.interval_m, no_rpe);
  internal::set_or_explain(json, "rpe_deg", degrees, no_rpe);
  set_metric(json, "mom_m2", evaluation.mom);
  set_metric(json, "omme_nats", evaluation.omme);
  set_metric(json, "mpv_m2", evaluation.mpv);
  set_metric(json, "mme_nats", evaluation.mme);
  internal::set_or_explain(json, "multi_scan_share", evaluation.overlap.multi_scan_share,
                           "no neighborhood has enough points");
  if (evaluation.rpe_estimate) {
    json["rpe_estimate"] = {{"status", name_of(evaluation.rpe_estimate->status)},
                            {"reasons", evaluation.rpe_estimate->reasons}};
  } else {
    json["rpe_estimate"] = nullptr;
    json["rpe_estimate_reason"] = kNotAskedFor;
  }
  json["warnings"] = Json::array();
  for (const Diagnostic& warning : evaluation.warnings) {
    json["warnings"].push_back({{"code", warning.code}, {"message", warning.message}});
  }
  return json;
}

Json pair_json(const PairedDifference& pair, const Comparison& comparison) {
  const auto name = [&](std::size_t i) { return comparison.trajectories[i].name; };
  Json json = {{"first", name(pair.first)}, {"second", name(pair.second)}};
  json["num_windows"] = pair.num_windows;
  json["num_first_better"] = pair.num_first_better;
  json["windows_can_tell"] = pair.windows_can_tell;
  const std::string no_window = "there is no window in which both have a value";
  internal::set_or_explain(json, "mean_difference", pair.mean_difference, no_window);
  set_interval(json, "interval", pair.interval,
               pair.mean_difference ? "too few windows to exclude anything" : no_window);
  internal::set_or_explain(json, "p_value", pair.p_value, no_window);
  internal::set_or_explain(json, "p_adjusted", pair.p_adjusted, no_window);
  json["better"] = pair.better ? Json(name(*pair.better)) : Json(nullptr);
  if (!pair.better) json["better_reason"] = pair.mean_difference ? "they cannot be told apart" : no_window;
  return json;
}

Json metric_json(const MetricComparison& metric, const Comparison& comparison) {
  Json json = {{"metric", name_of(metric.metric)}, {"unit", unit_of(metric.metric)}};
  json["pairs"] = Json::array();
  for (const PairedDifference& pair : metric.pairs) json["pairs"].push_back(pair_json(pair, comparison));
  json["ranks"] = Json::array();
  for (std::size_t i = 0; i < metric.ranks.size(); ++i) {
    json["ranks"].push_back({{"name", comparison.trajectories[i].name}, {"rank", metric.ranks[i]}});
  }
  return json;
}

Json settings_json(const Comparison& comparison) {
  const EvaluationSettings& settings = comparison.settings.evaluation;
  Json metrics = Json::array();
  for (const Metric metric : settings.metrics) metrics.push_back(name_of(metric));
  return {{"metrics", std::move(metrics)},
          {"definition", name_of(settings.definition)},
          {"radius_m", settings.radius_m},
          {"min_neighbors", settings.min_neighbors},
          {"query_every", settings.query_every},
          {"min_range_m", settings.min_range_m},
          {"max_range_m", internal::number_or_null(settings.max_range_m)},
          {"window", settings.window.value_or(0)},
          {"stride", settings.stride.value_or(0)},
          {"confidence", comparison.settings.confidence},
          {"adjustment", internal::adjustment_settings_json(settings.adjustment)}};
}

void set_adjusted(Json& json, const Comparison& comparison) {
  const bool has_adjusted = comparison.adjusted_from.has_value();
  const std::string no_rpe = comparison.trajectories.empty() ? "" : no_rpe_reason(comparison.trajectories.front());
  json["adjusted_from"] = has_adjusted ? Json(comparison.trajectories[*comparison.adjusted_from].name) : Json(nullptr);
  if (!has_adjusted) json["adjusted_from_reason"] = no_rpe;
  internal::set_or_explain(json, "adjusted_agreement_m", comparison.adjusted_agreement_m,
                           has_adjusted ? "no other trajectory has adjusted poses" : no_rpe);
}

Json verdict_json(const Comparison& comparison) {
  Json json = {{"meaningful", comparison.verdict.meaningful}, {"reasons", comparison.verdict.reasons}};
  json["metric"] = comparison.decisive ? Json(name_of(*comparison.decisive)) : Json(nullptr);
  if (!comparison.decisive) json["metric_reason"] = "nothing can be compared: see reasons";
  json["best"] = Json::array();
  for (const std::size_t i : comparison.best) json["best"].push_back(comparison.trajectories[i].name);
  return json;
}

/// A field of a CSV file: in quotes, as names may hold anything.
std::string csv_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

void append_cell(std::string& row, const std::optional<double>& value) {
  row += ',';
  if (value) row += fmt::format("{}", *value);
}

}  // namespace

std::string_view unit_of(Metric metric) {
  switch (metric) {
    case Metric::kRpe:
      return "m";
    case Metric::kMom:
    case Metric::kMpv:
      return "m2";
    default:
      return "nats";
  }
}

std::string to_json(const Comparison& comparison, const ComparisonFacts& facts) {
  Json json = {{"schema", "trysquare.comparison/1"}, {"version", facts.version}};
  const std::size_t num_scans = comparison.trajectories.front().evaluation.inputs.num_scans;
  json["inputs"] = {{"scans", facts.scans}, {"left_handed", facts.left_handed}, {"num_scans", num_scans}};
  json["settings"] = settings_json(comparison);
  json["trajectories"] = Json::array();
  for (std::size_t i = 0; i < comparison.trajectories.size(); ++i) {
    json["trajectories"].push_back(trajectory_json(comparison.trajectories[i], facts.sources.at(i)));
  }
  set_adjusted(json, comparison);
  json["comparisons"] = Json::array();
  for (const MetricComparison& metric : comparison.by_metric) {
    json["comparisons"].push_back(metric_json(metric, comparison));
  }
  json["verdict"] = verdict_json(comparison);
  return internal::dump(json);
}

std::string windows_csv(const Comparison& comparison) {
  std::string text = "trajectory,first,last,rpe_m,mom_m2,omme_nats,mpv_m2,mme_nats,multi_scan_share\n";
  for (const ComparedTrajectory& trajectory : comparison.trajectories) {
    for (const WindowEvaluation& window : trajectory.evaluation.windows) {
      std::string row = fmt::format("{},{},{}", csv_text(trajectory.name), window.first, window.last);
      append_cell(row, window.rpe_estimate_m);
      append_cell(row, window.mom.value);
      append_cell(row, window.omme.value);
      append_cell(row, window.mpv.value);
      append_cell(row, window.mme.value);
      append_cell(row, window.overlap.multi_scan_share);
      text += row + "\n";
    }
  }
  return text;
}

}  // namespace trysquare
