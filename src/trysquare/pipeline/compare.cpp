// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/compare.h"

#include "trysquare/core/error.h"
#include "trysquare/pipeline/evaluate.h"
#include "trysquare/stats/paired_test.h"
#include "trysquare/trajectory/all_pairs_rpe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace trysquare {
namespace {

constexpr std::size_t kWantedWindows = 10;
constexpr std::size_t kLargestWindow = 10;

void validate(std::size_t num_scans, std::span<const Candidate> candidates) {
  if (candidates.size() < 2) throw InvalidArgument("a comparison needs at least two trajectories");
  std::set<std::string> names;
  for (const Candidate& candidate : candidates) {
    if (!names.insert(candidate.name).second) {
      throw InvalidArgument(fmt::format("two trajectories are called \"{}\"", candidate.name));
    }
    if (candidate.world_from_scan.size() != num_scans) {
      throw InvalidArgument(fmt::format("{}: {} poses for {} scans: there must be one pose per scan", candidate.name,
                                        candidate.world_from_scan.size(), num_scans));
    }
  }
}

void resolve_window(EvaluationSettings& settings, std::size_t num_scans) {
  if (!settings.window) settings.window = std::clamp<std::size_t>(num_scans / kWantedWindows, 2, kLargestWindow);
}

/// Points are many, candidates may be, too.
void forget_points(Evaluation& evaluation) {
  evaluation.map = {};
  evaluation.query_indices = {};
  evaluation.query_statistics = {};
  evaluation.subset = {};
}

/// The candidate whose own estimate is accepted and smallest: its adjustment had the shortest way.
std::optional<std::size_t> best_estimate(const std::vector<ComparedTrajectory>& trajectories) {
  std::optional<std::size_t> best;
  const auto rms_m = [&](std::size_t i) { return *trajectories[i].evaluation.rpe_estimate->translation_rms_m; };
  for (std::size_t i = 0; i < trajectories.size(); ++i) {
    const std::optional<RpeEstimate>& estimate = trajectories[i].evaluation.rpe_estimate;
    if (!estimate || estimate->status == EstimateStatus::kRefused) continue;
    if (!best || rms_m(i) < rms_m(*best)) best = i;
  }
  return best;
}

std::optional<double> agreement_of(const std::vector<ComparedTrajectory>& trajectories, const Trajectory& adjusted,
                                   std::size_t adjusted_from) {
  std::optional<double> largest_m;
  for (std::size_t i = 0; i < trajectories.size(); ++i) {
    const std::optional<RpeEstimate>& estimate = trajectories[i].evaluation.rpe_estimate;
    if (i == adjusted_from || !estimate || estimate->adjusted.size() == 0) continue;
    const double rms_m = all_pairs_rpe(adjusted, estimate->adjusted).translation_m.rmse;
    largest_m = std::max(largest_m.value_or(0), rms_m);
  }
  return largest_m;
}

Trajectory slice(const Trajectory& trajectory, const WindowEvaluation& window) {
  const auto begin = trajectory.world_from_scan.begin();
  return {.world_from_scan = {begin + static_cast<std::ptrdiff_t>(window.first),
                              begin + static_cast<std::ptrdiff_t>(window.last + 1)}};
}

/// The RPE of a candidate, whole and by window, against poses that all share.
void measure(const Trajectory& trajectory, const RpeEstimate& common, ComparedTrajectory& result) {
  const AllPairsRpe rpe = all_pairs_rpe(common.adjusted, trajectory);
  const auto without_noise = [](double rms, double sigma) {
    return std::sqrt(std::max(0.0, rms * rms - sigma * sigma));
  };
  result.rpe_m = without_noise(rpe.translation_m.rmse, common.pair_sigma_m);
  result.rpe_rad = without_noise(rpe.rotation_rad.rmse, common.pair_sigma_rad);
  const double reach_m = interval_reach_m(common);
  result.interval_m = Interval{std::max(0.0, *result.rpe_m - reach_m), *result.rpe_m + reach_m};
  for (WindowEvaluation& window : result.evaluation.windows) {
    window.rpe_estimate_m = all_pairs_rpe(slice(common.adjusted, window), slice(trajectory, window)).translation_m.rmse;
  }
}

/// Empty where the window says nothing about the trajectory.
std::optional<double> value_of(const WindowEvaluation& window, Metric metric) {
  if (metric == Metric::kRpe) return window.rpe_estimate_m;
  if (!window.meaningful) return std::nullopt;
  switch (metric) {
    case Metric::kMom:
      return window.mom.value;
    case Metric::kOmme:
      return window.omme.value;
    case Metric::kMpv:
      return window.mpv.value;
    default:
      return window.mme.value;
  }
}

PairedDifference difference_between(const std::vector<ComparedTrajectory>& trajectories, std::size_t first,
                                    std::size_t second, Metric metric, double confidence) {
  PairedDifference result{.first = first, .second = second};
  const std::vector<WindowEvaluation>& of_first = trajectories[first].evaluation.windows;
  const std::vector<WindowEvaluation>& of_second = trajectories[second].evaluation.windows;
  std::vector<double> differences;
  for (std::size_t w = 0; w < of_first.size(); ++w) {
    const std::optional<double> a = value_of(of_first[w], metric);
    const std::optional<double> b = value_of(of_second[w], metric);
    if (!a || !b) continue;
    differences.push_back(*a - *b);
    result.num_first_better += *a < *b ? 1U : 0U;
  }
  result.num_windows = differences.size();
  if (differences.empty()) return result;
  const PairedTest test = paired_test(differences, confidence);
  result.mean_difference = test.mean;
  result.interval = test.interval;
  result.p_value = test.p_value;
  return result;
}

/// The least p-value that so many windows can give, corrected for so many pairs, is no finding: nothing can be one.
bool windows_can_tell(const PairedDifference& pair, std::size_t num_pairs, double confidence) {
  if (pair.num_windows == 0) return false;
  const double least = least_p_value(pair.num_windows);
  return static_cast<double>(num_pairs) * least <= 1 - confidence;
}

/// Corrects the p-values of all pairs for their number, and says which differences are real.
void decide(double confidence, std::vector<PairedDifference>& pairs) {
  std::vector<double> p_values;
  for (const PairedDifference& pair : pairs) p_values.push_back(pair.p_value.value_or(1));
  const std::vector<double> adjusted = holm_adjusted(p_values);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].windows_can_tell = windows_can_tell(pairs[i], pairs.size(), confidence);
    if (!pairs[i].p_value) continue;
    pairs[i].p_adjusted = adjusted[i];
    if (adjusted[i] <= 1 - confidence)
      pairs[i].better = *pairs[i].mean_difference < 0 ? pairs[i].first : pairs[i].second;
  }
}

/// Where windows are too few for a test, the RPE of two candidates still differs when their intervals do not meet.
void decide_by_intervals(const std::vector<ComparedTrajectory>& trajectories, std::vector<PairedDifference>& pairs) {
  for (PairedDifference& pair : pairs) {
    const std::optional<Interval>& first = trajectories[pair.first].interval_m;
    const std::optional<Interval>& second = trajectories[pair.second].interval_m;
    if (pair.windows_can_tell || !first || !second) continue;
    if (first->high < second->low) pair.better = pair.first;
    if (second->high < first->low) pair.better = pair.second;
  }
}

MetricComparison compare_by(Metric metric, const std::vector<ComparedTrajectory>& trajectories, double confidence) {
  MetricComparison result{.metric = metric};
  for (std::size_t second = 1; second < trajectories.size(); ++second) {
    for (std::size_t first = 0; first < second; ++first) {
      result.pairs.push_back(difference_between(trajectories, first, second, metric, confidence));
    }
  }
  decide(confidence, result.pairs);
  if (metric == Metric::kRpe) decide_by_intervals(trajectories, result.pairs);
  result.ranks.assign(trajectories.size(), 1);
  for (const PairedDifference& pair : result.pairs) {
    if (pair.better) ++result.ranks[*pair.better == pair.first ? pair.second : pair.first];
  }
  return result;
}

bool has_values(const MetricComparison& comparison) {
  return std::any_of(comparison.pairs.begin(), comparison.pairs.end(),
                     [](const PairedDifference& pair) { return pair.mean_difference.has_value(); });
}

/// The RPE, in metres, or else the first metric that two candidates have.
const MetricComparison* decisive_of(const std::vector<MetricComparison>& by_metric) {
  const MetricComparison* decisive = nullptr;
  for (const MetricComparison& each : by_metric) {
    if (has_values(each) && (!decisive || each.metric == Metric::kRpe)) decisive = &each;
  }
  return decisive;
}

void conclude(Comparison& result) {
  const MetricComparison* decisive = decisive_of(result.by_metric);
  if (!decisive) {
    result.verdict.reasons.emplace_back("no two trajectories have a value in the same window");
    for (const ComparedTrajectory& each : result.trajectories) {
      for (const std::string& reason : each.evaluation.verdict.reasons) {
        result.verdict.reasons.push_back(each.name + ": " + reason);
      }
    }
    return;
  }
  result.verdict.meaningful = true;
  result.decisive = decisive->metric;
  for (std::size_t i = 0; i < decisive->ranks.size(); ++i) {
    if (decisive->ranks[i] == 1) result.best.push_back(i);
  }
}

}  // namespace

void ComparisonSettings::validate() const {
  evaluation.validate();
  if (evaluation.stride && evaluation.window && *evaluation.stride < *evaluation.window) {
    throw InvalidArgument(fmt::format("windows of {} scans every {} overlap: a comparison needs separate ones",
                                      *evaluation.window, *evaluation.stride));
  }
  if (!(confidence > 0 && confidence < 1)) {
    throw InvalidArgument(fmt::format("confidence = {} is out of range: it must be in (0, 1)", confidence));
  }
}

Comparison compare(const ScanSequence& scans, std::span<const Candidate> candidates, const ComparisonSettings& settings,
                   const Execution& execution) {
  settings.validate();
  validate(scans.size(), candidates);
  Comparison result{.settings = settings};
  resolve_window(result.settings.evaluation, scans.size());
  result.settings.validate();  // the window may be too long for the stride
  for (const Candidate& candidate : candidates) {
    if (execution.progress) execution.progress("trajectories", result.trajectories.size(), candidates.size());
    result.trajectories.push_back({.name = candidate.name,
                                   .evaluation = evaluate(scans, candidate.world_from_scan, result.settings.evaluation,
                                                          {.body_from_sensor = candidate.body_from_sensor},
                                                          {.num_threads = execution.num_threads})});
    forget_points(result.trajectories.back().evaluation);
  }
  if (execution.progress) execution.progress("trajectories", candidates.size(), candidates.size());
  result.settings.evaluation = result.trajectories.front().evaluation.settings;  // with window and stride resolved

  result.adjusted_from = best_estimate(result.trajectories);
  if (result.adjusted_from) {
    const RpeEstimate common = *result.trajectories[*result.adjusted_from].evaluation.rpe_estimate;
    result.adjusted_agreement_m = agreement_of(result.trajectories, common.adjusted, *result.adjusted_from);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      measure(candidates[i].world_from_scan, common, result.trajectories[i]);
    }
  }
  for (const Metric metric : settings.evaluation.metrics) {
    result.by_metric.push_back(compare_by(metric, result.trajectories, settings.confidence));
  }
  conclude(result);
  return result;
}

}  // namespace trysquare
