// SPDX-License-Identifier: Apache-2.0
#include "result_table.h"

#include "trysquare/trajectory/error_unit.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace trysquare::app {
namespace {

std::string bold(std::string_view text, bool color) {
  return color ? fmt::format("\033[1m{}\033[0m", text) : std::string(text);
}

std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
  return digits;
}

/// A variance with the length that it is the square of, which is what one can picture.
std::string variance(double m2) { return fmt::format("{:<11.6g} m²    σ = {:.3g} mm", m2, 1000 * std::sqrt(m2)); }

std::string nats(double value) { return fmt::format("{:<11.6g} nats", value); }

using Format = std::string (*)(double);

std::string row(std::string_view name, const std::optional<double>& value, const std::string& reason, Format format) {
  return fmt::format("  {:<6} {}\n", name, value ? format(*value) : "undefined: " + reason);
}

std::string map_row(std::string_view name, const MetricResult& metric, Format format) {
  std::string text = row(name, metric.value, metric.reason, format);
  text.pop_back();
  return text +
         fmt::format("   {} of {} points used{}\n", grouped(metric.num_used), grouped(metric.num_queries),
                     metric.num_degenerate > 0 ? fmt::format(", {} degenerate", grouped(metric.num_degenerate)) : "");
}

std::string orthogonal_row(std::string_view name, const OrthogonalMetricResult& metric, Format format) {
  std::string text = row(name, metric.value, metric.reason, format);
  if (!metric.value) return text;
  text.pop_back();
  text += "   directions:";
  for (const OrthogonalMetricResult::Direction& direction : metric.directions) {
    text += " " + grouped(direction.num_used);
  }
  return text + " points\n";
}

std::string overlap_row(const Overlap& overlap, std::size_t num_scans) {
  if (!overlap.scans_per_neighborhood_mean) return "";
  return fmt::format("  overlap: a neighborhood holds {:.1f} of {} scans on average; {:.1f} % hold two or more\n",
                     *overlap.scans_per_neighborhood_mean, num_scans, 100 * *overlap.multi_scan_share);
}

std::string reference_rows(const ReferenceErrors& reference) {
  std::string text = fmt::format("  RPE    {:<11.6g} m     rmse over {} pairs; rotation {:.4g}°\n", reference.rpe.rmse,
                                 grouped(reference.rpe.count), reference.rpe_rotation.rmse * 180 / std::numbers::pi);
  if (reference.ape) {
    text += fmt::format("  APE    {:<11.6g} m     rmse after SE(3) alignment\n", reference.ape->rmse);
  } else {
    text += fmt::format("  APE    undefined: {}\n", reference.ape_reason);
  }
  return text;
}

constexpr const char* kHint = "         trysquare diagnose says what may be wrong\n";

/// Of poses that are near each other, which may be known where all pairs are not.
std::string near_pair_rows(const RpeEstimate& estimate) {
  std::string text;
  for (const PairRpe& each : estimate.by_pairs) {
    if (!each.translation_rms_m) continue;
    const bool is_next = each.pairs.unit == DeltaUnit::kFrames && each.pairs.delta == 1;
    text += "         ";
    text += is_next
                ? "from one pose to the next"
                : fmt::format("over {:g} {}", each.pairs.delta, each.pairs.unit == DeltaUnit::kMetres ? "m" : "poses");
    text += each.interval_m ? fmt::format(": {:.3g} m, {:.3g} to {:.3g} m\n", *each.translation_rms_m,
                                          (*each.interval_m)[0], (*each.interval_m)[1])
                            : fmt::format(": at most {:.3g} m\n", *each.upper_bound_m);
  }
  return text;
}

std::string refusal(const RpeEstimate& estimate) {
  std::string text = "  RPE    no estimate:\n";
  for (const std::string& reason : estimate.reasons) text += "         - " + reason + "\n";
  return text + near_pair_rows(estimate) + kHint;
}

/// The RPE without ground truth, what it is worth, and the poses that stand out.
std::string estimate_rows(const RpeEstimate& estimate) {
  if (estimate.status == EstimateStatus::kRefused) return refusal(estimate);
  constexpr double kDegrees = 180 / std::numbers::pi;
  const double rotation_deg = *estimate.rotation_rms_rad * kDegrees;
  std::string text;
  if (estimate.interval_m) {
    text =
        fmt::format("  RPE    {:<11.4g} m     estimated without ground truth: {:.3g} to {:.3g} m; rotation {:.3g}°\n",
                    *estimate.translation_rms_m, (*estimate.interval_m)[0], (*estimate.interval_m)[1], rotation_deg);
  } else {
    text = fmt::format("  RPE    ≤ {:<9.4g} m     estimated without ground truth: too small to measure\n",
                       *estimate.upper_bound_m);
  }
  text += near_pair_rows(estimate);
  if (estimate.systematic_indicator_m) {
    text += fmt::format("         near and far surfaces alone differ by {:.3g} m: what the sensor itself bends\n",
                        *estimate.systematic_indicator_m);
  }
  bool any_suspect = false;
  for (std::size_t i = 0; i < estimate.poses.size(); ++i) {
    const PoseDeviation& deviation = estimate.poses[i].deviation;
    if (!deviation.suspect) continue;
    text += fmt::format("         pose {} stands out: {:.3g} m and {:.3g}° from those around it\n", i,
                        deviation.error.translation_m.norm(), deviation.error.rotation_rad.norm() * kDegrees);
    any_suspect = true;
  }
  return any_suspect ? text + kHint : text;
}

}  // namespace

std::string evaluation_table(const Evaluation& evaluation, bool color) {
  const EvaluationInputs& inputs = evaluation.inputs;
  std::string text = fmt::format("{} scan{}, {} points, radius {:g} m, definition {}\n\n", inputs.num_scans,
                                 inputs.num_scans == 1 ? "" : "s", grouped(inputs.num_points),
                                 evaluation.settings.radius_m, name_of(evaluation.settings.definition));
  if (evaluation.mom) text += orthogonal_row("MOM", *evaluation.mom, variance);
  if (evaluation.mpv) text += map_row("MPV", *evaluation.mpv, variance);
  if (evaluation.mme) text += map_row("MME", *evaluation.mme, nats);
  if (evaluation.omme) text += orthogonal_row("OMME", *evaluation.omme, nats);
  if (evaluation.rpe_estimate) text += estimate_rows(*evaluation.rpe_estimate);
  if (evaluation.reference) text += reference_rows(*evaluation.reference);
  text += overlap_row(evaluation.overlap, inputs.num_scans);
  const Verdict& verdict = evaluation.verdict;
  text +=
      "\n" + bold(verdict.meaningful ? "The numbers are meaningful." : "The numbers mean nothing here:", color) + "\n";
  for (const std::string& reason : verdict.reasons) text += "  - " + reason + "\n";
  return text;
}

std::string errors_table(std::string_view title, const TrajectoryErrors& errors) {
  const ErrorStatistics& statistics = errors.statistics;
  const std::string_view unit = unit_of(errors);
  std::string text = fmt::format("{}\n\n", title);
  const auto add = [&](std::string_view name, double value) {
    text += fmt::format("  {:<7} {:<12.8g} {}\n", name, value, unit);
  };
  add("rmse", statistics.rmse);
  add("mean", statistics.mean);
  add("median", statistics.median);
  add("std", statistics.std);
  add("min", statistics.min);
  add("max", statistics.max);
  return text + fmt::format("  {:<7} {:.8g}\n", "sse", statistics.sse);
}

namespace {

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

std::string drift_row(const std::string& length, const std::optional<Drift>& drift) {
  if (!drift) return fmt::format("  {:>9}  {:>10}  {:>10}  {:>8}\n", length, "-", "-", 0);
  return fmt::format("  {:>9}  {:>10.4f}  {:>10.4f}  {:>8}\n", length, drift->translation_percent,
                     drift->rotation_deg_per_100m, drift->num_segments);
}

std::string kitti_table(const KittiDrift& drift) {
  std::string text =
      fmt::format("\nKITTI drift\n\n  {:>9}  {:>10}  {:>10}  {:>8}\n", "length", "%", "deg/100 m", "segments");
  for (const KittiDrift::OfLength& of_length : drift.by_length) {
    text += drift_row(fmt::format("{:g} m", of_length.length_m), of_length.drift);
  }
  text += drift_row("mean", drift.mean);
  return drift.reason.empty() ? text : text + fmt::format("  undefined: {}\n", drift.reason);
}

std::string by_length_table(const std::vector<ErrorOfLength>& errors) {
  std::string text = fmt::format("\nErrors by length (mean)\n\n  {:>9}  {:>10}  {:>8}  {:>8}  {:>8}\n", "length", "m",
                                 "%", "deg", "pairs");
  for (const ErrorOfLength& error : errors) {
    const std::string length = fmt::format("{:.4g} m", error.length_m);
    text += error.translation_m ? fmt::format("  {:>9}  {:>10.4g}  {:>8.4g}  {:>8.4g}  {:>8}\n", length,
                                              error.translation_m->mean, error.translation_percent->mean,
                                              error.rotation_rad->mean * kDegreesPerRadian, error.translation_m->count)
                                : fmt::format("  {:>9}  undefined: {}\n", length, error.reason);
  }
  return text;
}

}  // namespace

std::string relative_errors_table(const RelativeErrors& others) {
  std::string text;
  if (others.kitti_drift) text += kitti_table(*others.kitti_drift);
  if (!others.by_length.empty()) text += by_length_table(others.by_length);
  if (others.every_pair) {
    text +=
        fmt::format("\nEvery pair ({} pairs)\n\n  rmse    {:.8g} m, {:.8g} deg\n  median  {:.8g} m, {:.8g} deg\n",
                    others.every_pair->translation_m.count, others.every_pair->translation_m.rmse,
                    others.every_pair->rotation_rad.rmse * kDegreesPerRadian, others.every_pair->translation_m.median,
                    others.every_pair->rotation_rad.median * kDegreesPerRadian);
  }
  if (others.paper_rpe_m2) text += fmt::format("  the paper's RPE {:.8g} m²\n", *others.paper_rpe_m2);
  return text;
}

}  // namespace trysquare::app
