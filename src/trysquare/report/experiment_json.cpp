// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/experiment_json.h"

#include "trysquare/core/error.h"
#include "trysquare/experiments/simulated_drive.h"
#include "trysquare/report/internal/json.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace trysquare {
namespace {

using internal::Json;

/// Degrees as they were typed: 0.2, not 0.20000000000000004.
double degrees(double rad) { return std::round(rad * 180 / std::numbers::pi * 1e12) / 1e12; }

Json settings_of(const ExperimentSettings& settings, const ExperimentFacts& facts) {
  std::vector<double> rotations_deg;
  for (const double sigma_rad : settings.rotation_sigmas_rad) rotations_deg.push_back(degrees(sigma_rad));
  Json json = {{"num_environments", settings.num_environments},
               {"num_poses", settings.num_poses},
               {"num_trajectories", settings.num_trajectories},
               {"noise_model", name_of(settings.noise_model)},
               {"translation_sigma_m", settings.translation_sigma_m},
               {"rotation_sigmas_deg", rotations_deg},
               {"radius_m", settings.radius_m},
               {"num_queries", settings.scene.num_queries},
               {"num_points_per_direction", settings.scene.num_points_per_direction},
               {"intervals", name_of(settings.intervals)},
               {"confidence", settings.bootstrap.confidence},
               {"num_resamples", settings.bootstrap.num_resamples},
               {"seed", settings.seed}};
  if (facts.scans) json["scans"] = *facts.scans;
  if (facts.poses) json["poses"] = *facts.poses;
  if (settings.kind == ExperimentKind::kPlanes || settings.kind == ExperimentKind::kCounterexample) {
    json["point_sigma_m"] = settings.point_sigma_m;
  }
  if (settings.kind == ExperimentKind::kStreet || settings.kind == ExperimentKind::kTown) {
    json["sensor"] = kDriveSensor;
  }
  return json;
}

Json json_of(const CoefficientSummary& summary) {
  Json json = {{"num_defined", summary.num_defined},           {"mean", internal::number_or_null(summary.mean)},
               {"std", internal::number_or_null(summary.std)}, {"mean_interval", nullptr},
               {"min", internal::number_or_null(summary.min)}, {"max", internal::number_or_null(summary.max)}};
  if (summary.mean_interval) {
    json["mean_interval"] = Json::array({summary.mean_interval->low, summary.mean_interval->high});
  } else {
    json["reason"] = summary.mean ? "one environment has no spread" : "undefined in every environment";
  }
  return json;
}

void append_cell(std::string& line, std::optional<double> value) {
  line += ',';
  if (value) line += fmt::format("{}", *value);
}

void append_ends(std::string& line, const std::optional<Interval>& interval) {
  append_cell(line, interval ? std::optional(interval->low) : std::nullopt);
  append_cell(line, interval ? std::optional(interval->high) : std::nullopt);
}

}  // namespace

std::string settings_json(const ExperimentSettings& settings, const ExperimentFacts& facts) {
  return internal::dump(Json{{"schema", "trysquare.experiment-settings/1"},
                             {"version", facts.version},
                             {"experiment", name_of(settings.kind)},
                             {"settings", settings_of(settings, facts)}});
}

std::string to_json(const ExperimentSettings& settings, std::span<const GroupSummary> groups,
                    const ExperimentFacts& facts) {
  Json json = {{"schema", "trysquare.experiment/1"},
               {"version", facts.version},
               {"experiment", name_of(settings.kind)},
               {"settings", settings_of(settings, facts)}};
  json["groups"] = Json::array();
  for (const GroupSummary& group : groups) {
    Json metrics = Json::array();
    for (const MetricSummary& metric : group.metrics) {
      Json entry = {{"metric", metric.metric}, {"num_environments", metric.num_environments}};
      for (std::size_t c = 0; c < kCoefficients.size(); ++c) {
        entry[std::string(name_of(kCoefficients.at(c)))] = json_of(metric.coefficients.at(c));
      }
      metrics.push_back(std::move(entry));
    }
    json["groups"].push_back({{"group", group.group},
                              {"rotation_sigma_deg", degrees(group.rotation_sigma_rad)},
                              {"num_poses", group.num_poses},
                              {"metrics", std::move(metrics)}});
  }
  return internal::dump(json);
}

std::string correlations_csv(std::span<const ExperimentUnit> units,
                             std::span<const std::vector<MetricCorrelation>> correlations) {
  if (units.size() != correlations.size()) {
    throw InvalidArgument(fmt::format("{} units but {} correlations", units.size(), correlations.size()));
  }
  std::string text = "group,environment,rotation_sigma_deg,num_poses,metric,num_defined";
  for (const Coefficient coefficient : kCoefficients)
    text += fmt::format(",{0},{0}_low,{0}_high", name_of(coefficient));
  text += '\n';
  for (std::size_t i = 0; i < units.size(); ++i) {
    for (const MetricCorrelation& metric : correlations[i]) {
      text += fmt::format("{},{},{},{},{},{}", units[i].group, units[i].environment,
                          degrees(units[i].rotation_sigma_rad), units[i].num_poses, metric.metric, metric.num_defined);
      for (const CoefficientEstimate& estimate : metric.coefficients) {
        append_cell(text, estimate.value);
        append_ends(text, estimate.interval);
      }
      text += '\n';
    }
  }
  return text;
}

std::string summary_csv(std::span<const GroupSummary> groups) {
  std::string text = "group,rotation_sigma_deg,num_poses,metric,num_environments";
  for (const Coefficient coefficient : kCoefficients) {
    text += fmt::format(",{0}_mean,{0}_std,{0}_mean_low,{0}_mean_high,{0}_min,{0}_max", name_of(coefficient));
  }
  text += '\n';
  for (const GroupSummary& group : groups) {
    for (const MetricSummary& metric : group.metrics) {
      text += fmt::format("{},{},{},{},{}", group.group, degrees(group.rotation_sigma_rad), group.num_poses,
                          metric.metric, metric.num_environments);
      for (const CoefficientSummary& summary : metric.coefficients) {
        append_cell(text, summary.mean);
        append_cell(text, summary.std);
        append_ends(text, summary.mean_interval);
        append_cell(text, summary.min);
        append_cell(text, summary.max);
      }
      text += '\n';
    }
  }
  return text;
}

}  // namespace trysquare
