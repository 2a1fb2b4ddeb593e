// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/format_headline.h"

#include "trysquare/report/internal/format.h"
#include "trysquare/report/internal/format_html.h"

#include <fmt/format.h>

#include <cmath>

namespace trysquare::internal {
namespace {

constexpr double kMillimetresPerMetre = 1000;

std::string line(const std::string& html) { return "<div>" + html + "</div>\n"; }

/// A variance is hard to picture; its root is how thick the walls of the map are.
std::string wall_thickness(const Json& metric, const char* name) {
  if (!has(metric, "value") || metric.at("value").get<double>() < 0) return "";
  const double thickness_mm = std::sqrt(metric.at("value").get<double>()) * kMillimetresPerMetre;
  return line(fmt::format("wall thickness <b>{}</b> (√{})", quantity(thickness_mm, "mm"), name));
}

std::string support(const Json& metric) {
  return line(fmt::format("{} of {} query points used, {} with too few neighbors, {} degenerate",
                          count(metric.at("num_used")), count(metric.at("num_queries")),
                          count(metric.at("num_too_few")), count(metric.at("num_degenerate"))));
}

std::string metric_card(const Json& metrics, const std::string& key, const char* name, const char* meaning) {
  if (!has(metrics, key)) return html_card(name, meaning, html_undefined(reason_of(metrics, key)), "");
  const Json& metric = metrics.at(key);
  const std::string unit = metric.at("unit").get<std::string>();
  std::string lines = unit == "m2" ? wall_thickness(metric, name) : "";
  if (has(metric, "follows_trajectory_error") && !metric.at("follows_trajectory_error").get<bool>()) {
    lines += line("<b>does not follow the trajectory error</b>: fewer than three orthogonal directions");
  }
  return html_card(name, meaning, html_value(metric, "value", unit), lines + support(metric));
}

std::string overlap_card(const Json& overlap) {
  const std::string scans = html_value(overlap, "scans_per_neighborhood_mean", "scans");
  const std::string share = has(overlap, "multi_scan_share")
                                ? escape(quantity(100 * overlap.at("multi_scan_share").get<double>(), "%"))
                                : html_undefined(reason_of(overlap, "multi_scan_share"));
  return html_card("Overlap", "scans per neighborhood, mean", scans,
                   line("<b>" + share + "</b> of the neighborhoods hold two scans or more"));
}

/// The estimate without a reference: a quantity, or "undefined" and the reason.
std::string rpe_estimate(const Json& evaluation) {
  if (!has(evaluation, "rpe_estimate")) return html_undefined(reason_of(evaluation, "rpe_estimate"));
  const Json& estimate = evaluation.at("rpe_estimate");
  if (has(estimate, "upper_bound_m")) return "≤ " + html_value(estimate, "upper_bound_m", "m") + " (bound)";
  if (!has(estimate, "interval_m")) return html_value(estimate, "translation_rms_m", "m");
  const Json& interval = estimate.at("interval_m");
  return html_value(estimate, "translation_rms_m", "m") +
         escape(fmt::format(" ({} to {})", quantity(interval.at(0).get<double>(), "m"),
                            quantity(interval.at(1).get<double>(), "m")));
}

std::string rpe_card(const Json& evaluation) {
  if (!has(evaluation, "reference")) {
    return html_card("RPE", "estimated without a reference", rpe_estimate(evaluation), "");
  }
  const Json& reference = evaluation.at("reference");
  const std::string estimate = line("estimated without a reference: " + rpe_estimate(evaluation));
  const char* const meaning = "against the reference, rmse";
  if (!has(reference, "rpe")) return html_card("RPE", meaning, html_undefined(reason_of(reference, "rpe")), estimate);
  const Json& rpe = reference.at("rpe");
  const std::string pairs = line(fmt::format("translation over {} pairs of poses", count(rpe.at("num_pairs"))));
  return html_card("RPE", meaning, html_value(rpe, "rmse", rpe.at("unit").get<std::string>()), pairs + estimate);
}

}  // namespace

std::string html_verdict(const Json& evaluation) {
  const Json& verdict = evaluation.at("verdict");
  const bool is_meaningful = verdict.at("meaningful").get<bool>();
  std::string reasons;
  for (const Json& reason : verdict.at("reasons")) reasons += "<li>" + escape(reason.get<std::string>()) + "</li>\n";
  if (!reasons.empty()) reasons = "<ul>\n" + reasons + "</ul>\n";
  return fmt::format("<div class=\"verdict {}\"><strong>{}</strong>\n{}</div>\n", is_meaningful ? "good" : "bad",
                     is_meaningful ? "The numbers are meaningful" : "The numbers are not meaningful", reasons);
}

std::string html_headline(const Json& evaluation) {
  const Json& metrics = evaluation.at("metrics");
  return "<div class=\"cards\">\n" + metric_card(metrics, "mom", "MOM", "plane variance, orthogonal surfaces") +
         metric_card(metrics, "mpv", "MPV", "mean plane variance") +
         metric_card(metrics, "mme", "MME", "mean map entropy") +
         metric_card(metrics, "omme", "OMME", "map entropy, orthogonal surfaces") +
         overlap_card(evaluation.at("overlap")) + rpe_card(evaluation) + "</div>\n";
}

std::string html_warnings(const Json& evaluation) {
  std::string items;
  for (const Json& warning : evaluation.at("warnings")) {
    items +=
        fmt::format("<div class=\"warning\"><code>{}</code> {}</div>\n", escape(warning.at("code").get<std::string>()),
                    escape(warning.at("message").get<std::string>()));
  }
  return html_section("Warnings", items);
}

}  // namespace trysquare::internal
