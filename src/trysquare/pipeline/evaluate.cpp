// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/evaluate.h"

#include "trysquare/adjustment/rpe_estimate.h"
#include "trysquare/core/error.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/mapping/exact_duplicates.h"
#include "trysquare/pipeline/frame_check.h"
#include "trysquare/pipeline/map_metrics.h"
#include "trysquare/stats/correlation.h"
#include "trysquare/trajectory/all_pairs_rpe.h"
#include "trysquare/trajectory/ape.h"
#include "trysquare/trajectory/paper_rpe.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace trysquare {
namespace {

constexpr std::size_t kScansForDefaultWindows = 20;
constexpr std::size_t kDefaultWindow = 10;

/// Windows of ten consecutive scans, as in the paper's KITTI figure, unless asked for otherwise.
void resolve_windows(EvaluationSettings& settings, std::size_t num_scans) {
  if (!settings.window && num_scans >= kScansForDefaultWindows) settings.window = kDefaultWindow;
  if (settings.window && !settings.stride) settings.stride = settings.window;
}

void validate_reference(const EvaluationContext& context, const Trajectory& trajectory) {
  if (context.reference && context.reference->size() != trajectory.size()) {
    throw InvalidArgument(fmt::format("{} poses but {} reference poses: there must be one reference pose per scan",
                                      trajectory.size(), context.reference->size()));
  }
}

EvaluationInputs inputs_of(const AssembledMap& assembled) {
  return {.num_scans = assembled.map.num_scans,
          .num_points = assembled.map.points_in_map.size(),
          .num_not_finite_points = assembled.num_not_finite,
          .num_origin_points = assembled.num_at_origin,
          .num_out_of_range_points = assembled.num_out_of_range,
          .num_duplicate_points = count_exact_duplicates(assembled.map.points_in_map)};
}

/// Runs the metrics of the map and puts them into the evaluation, except for what concerns the trajectory.
void evaluate_assembled(AssembledMap assembled, const EvaluationContext& context, const Execution& execution,
                        Evaluation& result) {
  result.inputs = inputs_of(assembled);
  result.map = std::move(assembled.map);
  result.world_from_map = result.map.world_from_map;
  MapMetrics metrics = map_metrics(result.map, context.subset, result.settings, execution);
  if (result.settings.wants(Metric::kMpv)) result.mpv = std::move(metrics.mpv);
  if (result.settings.wants(Metric::kMme)) result.mme = std::move(metrics.mme);
  if (result.settings.wants(Metric::kMom)) result.mom = std::move(metrics.mom);
  if (result.settings.wants(Metric::kOmme)) result.omme = std::move(metrics.omme);
  result.overlap = metrics.overlap;
  result.query_indices = std::move(metrics.query_indices);
  result.query_statistics = std::move(metrics.query_statistics);
  result.subset = std::move(metrics.subset);
  if (!metrics.subset_reason.empty()) {
    result.warnings.push_back({"few_directions", metrics.subset_reason +
                                                     "; MOM and OMME of this scene can be compared between "
                                                     "trajectories, but are not expected to follow their error"});
  }
}

Trajectory slice(const Trajectory& trajectory, std::size_t first, std::size_t count) {
  const auto begin = trajectory.world_from_scan.begin() + static_cast<std::ptrdiff_t>(first);
  return {.world_from_scan = {begin, begin + static_cast<std::ptrdiff_t>(count)}};
}

WindowEvaluation evaluate_window(std::size_t first, const ScanSequence& scans, const Trajectory& trajectory,
                                 const EvaluationSettings& settings, const EvaluationContext& context,
                                 const Execution& execution) {
  const std::size_t count = *settings.window;
  const RegisteredMap map = assemble_map(scans, trajectory,
                                         {.first_scan = first,
                                          .num_scans = count,
                                          .min_range_m = settings.min_range_m,
                                          .max_range_m = settings.max_range_m},
                                         execution)
                                .map;
  std::optional<OrthogonalSubset> subset;
  if (context.subset) {
    const Pose window_from_world = general_inverse(trajectory.world_from_scan[first]);
    subset = transformed(window_from_world * trajectory.world_from_scan[0], *context.subset);
  }
  MapMetrics metrics = map_metrics(map, subset, settings, execution);
  WindowEvaluation window{.first = first,
                          .last = first + count - 1,
                          .mpv = std::move(metrics.mpv),
                          .mme = std::move(metrics.mme),
                          .mom = std::move(metrics.mom),
                          .omme = std::move(metrics.omme),
                          .overlap = metrics.overlap};
  const std::optional<double>& share = window.overlap.multi_scan_share;
  window.meaningful = share && *share >= kLeastMultiScanShare;
  if (context.reference) {
    window.rpe_translation_rms_m =
        all_pairs_rpe(slice(*context.reference, first, count), slice(trajectory, first, count), execution)
            .translation_m.rmse;
  }
  return window;
}

void warn_about_windows(Evaluation& result) {
  const std::size_t window = *result.settings.window;
  if (result.windows.empty()) {
    result.warnings.push_back(
        {"no_window", fmt::format("a window of {} scans does not fit into {}", window, result.inputs.num_scans)});
  } else if (result.num_scans_outside_windows > 0) {
    result.warnings.push_back(
        {"incomplete_window", fmt::format("the last {} scans fill no window of {} and are in none",
                                          result.num_scans_outside_windows, window)});
  }
  const auto num_isolated = std::count_if(result.windows.begin(), result.windows.end(),
                                          [](const WindowEvaluation& each) { return !each.meaningful; });
  if (num_isolated > 0) {
    result.warnings.push_back(
        {"isolated_windows", fmt::format("in {} of {} windows the scans hardly overlap; their values can look better "
                                         "than they are, and they are left out of correlations",
                                         num_isolated, result.windows.size())});
  }
}

void evaluate_windows(const ScanSequence& scans, const Trajectory& trajectory, const EvaluationContext& context,
                      const Execution& execution, Evaluation& result) {
  const EvaluationSettings& settings = result.settings;
  if (!settings.window) return;
  const std::size_t window = *settings.window;
  const std::size_t count = scans.size() < window ? 0 : (scans.size() - window) / *settings.stride + 1;
  for (std::size_t i = 0; i < count; ++i) {
    if (execution.progress) execution.progress("windows", i, count);
    result.windows.push_back(evaluate_window(i * *settings.stride, scans, trajectory, settings, context,
                                             {.num_threads = execution.num_threads}));
    if (execution.progress) execution.progress("windows", i + 1, count);
  }
  result.num_scans_outside_windows = count == 0 ? scans.size() : scans.size() - 1 - result.windows.back().last;
  warn_about_windows(result);
}

/// The RPE without a reference: of the whole trajectory, and of each window against the same adjusted poses.
void estimate_errors(const ScanSequence& scans, const Trajectory& trajectory, const Execution& execution,
                     Evaluation& result) {
  if (!result.settings.wants(Metric::kRpe)) return;
  AdjustmentSettings settings = result.settings.adjustment;
  settings.min_range_m = result.settings.min_range_m;
  settings.max_range_m = result.settings.max_range_m;
  result.rpe_estimate = estimate_rpe(scans, trajectory, settings, execution);
  const Trajectory& adjusted = result.rpe_estimate->adjusted;
  if (adjusted.size() == 0) return;
  for (WindowEvaluation& window : result.windows) {
    const std::size_t count = window.last + 1 - window.first;
    window.rpe_estimate_m =
        all_pairs_rpe(slice(adjusted, window.first, count), slice(trajectory, window.first, count)).translation_m.rmse;
  }
}

ReferenceErrors reference_errors(const Trajectory& reference, const Trajectory& trajectory,
                                 const Execution& execution) {
  const AllPairsRpe rpe = all_pairs_rpe(reference, trajectory, {.num_threads = execution.num_threads});
  ReferenceErrors errors{
      .rpe = rpe.translation_m, .rpe_rotation = rpe.rotation_rad, .paper_rpe = paper_rpe(reference, trajectory)};
  try {
    errors.ape = ape(reference, trajectory, {.alignment = Alignment::kSe3}).statistics;
  } catch (const InvalidArgument& error) {  // too few poses, or all on a line: a property of the data, not a mistake
    errors.ape_reason = error.what();
  }
  return errors;
}

WindowCorrelation correlate(const std::vector<WindowEvaluation>& windows, const std::string& name,
                            const std::optional<double>& (*value_of)(const WindowEvaluation&)) {
  std::vector<double> metric;
  std::vector<double> rpe_m;
  for (const WindowEvaluation& window : windows) {
    if (!window.meaningful || !value_of(window) || !window.rpe_translation_rms_m) continue;
    metric.push_back(*value_of(window));
    rpe_m.push_back(*window.rpe_translation_rms_m);
  }
  WindowCorrelation result{.metric = name, .num_windows = metric.size()};
  if (metric.size() < 3) return result;
  result.pearson = pearson(metric, rpe_m);
  result.spearman = spearman(metric, rpe_m);
  result.kendall_tau_b = kendall_tau_b(metric, rpe_m);
  return result;
}

void correlate_windows(Evaluation& result) {
  using Value = const std::optional<double>&;
  const auto add = [&](Metric metric, const std::string& name, Value (*value_of)(const WindowEvaluation&)) {
    if (result.settings.wants(metric)) result.window_correlations.push_back(correlate(result.windows, name, value_of));
  };
  add(Metric::kMom, "mom", [](const WindowEvaluation& window) -> Value { return window.mom.value; });
  add(Metric::kOmme, "omme", [](const WindowEvaluation& window) -> Value { return window.omme.value; });
  add(Metric::kMpv, "mpv", [](const WindowEvaluation& window) -> Value { return window.mpv.value; });
  add(Metric::kMme, "mme", [](const WindowEvaluation& window) -> Value { return window.mme.value; });
}

/// Why no metric that was asked for has a value; empty when one has.
std::vector<std::string> reasons_without_values(const Evaluation& result) {
  std::vector<std::string> reasons;
  bool any = false;
  const auto look_at = [&](const char* name, const auto& metric) {
    if (!metric) return;
    any = any || metric->value.has_value();
    if (!metric->value) reasons.push_back(fmt::format("{} is undefined: {}", name, metric->reason));
  };
  look_at("MPV", result.mpv);
  look_at("MME", result.mme);
  look_at("MOM", result.mom);
  look_at("OMME", result.omme);
  if (result.rpe_estimate) {
    any = any || result.rpe_estimate->status != EstimateStatus::kRefused;
    for (const std::string& reason : result.rpe_estimate->reasons) reasons.push_back("no RPE estimate: " + reason);
  }
  if (any) return {};
  if (reasons.empty()) reasons.emplace_back("no metric that can be computed was asked for");
  return reasons;
}

Verdict verdict_on_map(const Evaluation& result) {
  Verdict verdict{.reasons = reasons_without_values(result)};
  verdict.meaningful = verdict.reasons.empty();
  return verdict;
}

Verdict verdict_on_trajectory(const Evaluation& result) {
  Verdict verdict{.reasons = reasons_without_values(result)};
  const std::optional<double>& share = result.overlap.multi_scan_share;
  if (result.inputs.num_scans < 2) {
    verdict.reasons.push_back(fmt::format("{} scan{}: a trajectory shows only where scans see the same surfaces",
                                          result.inputs.num_scans, result.inputs.num_scans == 1 ? "" : "s"));
  } else if (!share) {
    verdict.reasons.emplace_back("no neighborhood has enough points to tell whether scans overlap");
  } else if (*share < kLeastMultiScanShare) {
    verdict.reasons.push_back(
        fmt::format("the scans hardly overlap: only {:.1f} % of the neighborhoods hold points of "
                    "two scans or more ({:.0f} % are needed), so the metrics are blind to the "
                    "poses and can look better than they are",
                    100 * *share, 100 * kLeastMultiScanShare));
  }
  verdict.meaningful = verdict.reasons.empty();
  return verdict;
}

/// Points that say nothing, when there are enough of them to matter.
void warn_about_points(const EvaluationInputs& inputs, bool origin_points_are_kept, std::vector<Diagnostic>& warnings) {
  constexpr double kMany = 0.001;
  const auto num_points = static_cast<double>(inputs.num_points);
  if (static_cast<double>(inputs.num_duplicate_points) > kMany * num_points) {
    warnings.push_back(
        {"duplicate_points", fmt::format("{} of {} points equal another one exactly; copies fill neighborhoods without "
                                         "telling anything",
                                         inputs.num_duplicate_points, inputs.num_points)});
  }
  if (origin_points_are_kept && static_cast<double>(inputs.num_origin_points) > kMany * num_points) {
    warnings.push_back({"origin_points", fmt::format("{} of {} points lie exactly at (0, 0, 0): invalid returns of a "
                                                     "sensor, most likely; they are part of the map all the same",
                                                     inputs.num_origin_points, inputs.num_points)});
  }
}

}  // namespace

Evaluation evaluate(const ScanSequence& scans, const Trajectory& trajectory, const EvaluationSettings& settings,
                    const EvaluationContext& context, const Execution& execution) {
  settings.validate();
  validate_reference(context, trajectory);
  Evaluation result{.settings = settings};
  resolve_windows(result.settings, scans.size());

  AssembledMap assembled = assemble_map(
      scans, trajectory, {.min_range_m = settings.min_range_m, .max_range_m = settings.max_range_m}, execution);
  evaluate_assembled(std::move(assembled), context, execution, result);
  for (const Pose& world_from_scan : trajectory.world_from_scan) {
    result.positions_in_map.push_back(general_inverse(result.world_from_map) * world_from_scan.translation);
  }

  if (auto finding = check_frames(scans, trajectory, context.body_from_sensor, settings.radius_m, execution)) {
    result.warnings.push_back(std::move(*finding));
  }
  warn_about_points(result.inputs, false, result.warnings);
  evaluate_windows(scans, trajectory, context, execution, result);
  estimate_errors(scans, trajectory, execution, result);
  if (context.reference && trajectory.size() >= 2) {
    result.reference = reference_errors(*context.reference, trajectory, execution);
    correlate_windows(result);
  }
  result.verdict = verdict_on_trajectory(result);
  return result;
}

Evaluation evaluate_map(const Scan& map, const EvaluationSettings& settings, const EvaluationContext& context,
                        const Execution& execution) {
  settings.validate();
  Evaluation result{.settings = settings};
  AssembledMap assembled{.map = {.points_in_map = map.points_in_scan, .num_scans = 1},
                         .num_not_finite = map.num_not_finite,
                         .num_at_origin = map.num_at_origin};
  assembled.map.scan_of_point.assign(map.points_in_scan.size(), 0);
  evaluate_assembled(std::move(assembled), context, execution, result);
  result.overlap.scans_per_neighborhood_mean.reset();  // which points belong to one scan is not known
  result.overlap.multi_scan_share.reset();
  warn_about_points(result.inputs, true, result.warnings);
  result.verdict = verdict_on_map(result);
  return result;
}

}  // namespace trysquare
