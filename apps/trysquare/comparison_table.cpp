// SPDX-License-Identifier: Apache-2.0
#include "comparison_table.h"

#include "trysquare/report/comparison_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string_view>
#include <vector>

namespace trysquare::app {
namespace {

std::string_view title_of(Metric metric) {
  switch (metric) {
    case Metric::kMme:
      return "MME";
    case Metric::kMpv:
      return "MPV";
    case Metric::kOmme:
      return "OMME";
    case Metric::kMom:
      return "MOM";
    case Metric::kRpe:
      break;
  }
  return "RPE";
}

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.4g}", *value) : "-"; }

template <typename Result>
std::string value_of(const std::optional<Result>& metric) {
  return metric ? number(metric->value) : "-";
}

std::string rpe_of(const ComparedTrajectory& trajectory) {
  if (!trajectory.rpe_m) return "-";
  if (trajectory.interval_m->low <= 0) return fmt::format("<= {:.3g}", trajectory.interval_m->high);
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", *trajectory.rpe_m, trajectory.interval_m->low,
                     trajectory.interval_m->high);
}

const MetricComparison* decisive_of(const Comparison& comparison) {
  for (const MetricComparison& each : comparison.by_metric) {
    if (comparison.decisive == each.metric) return &each;
  }
  return nullptr;
}

/// Cells in columns, the first to the left.
std::string in_columns(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const std::vector<std::string>& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string text;
  for (const std::vector<std::string>& row : rows) {
    text += "  " + fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t c = 1; c < row.size(); ++c) text += fmt::format("  {:>{}}", row[c], widths[c]);
    text += "\n";
  }
  return text;
}

std::string rows_of(const Comparison& comparison, const MetricComparison* decisive) {
  std::vector<std::size_t> order(comparison.trajectories.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (decisive) {
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return decisive->ranks[a] < decisive->ranks[b]; });
  }
  std::vector<std::vector<std::string>> rows = {
      {"trajectory", "rank", "RPE [m]", "MOM [m2]", "MPV [m2]", "MME", "OMME"}};
  for (const std::size_t i : order) {
    const ComparedTrajectory& trajectory = comparison.trajectories[i];
    const Evaluation& evaluation = trajectory.evaluation;
    rows.push_back({trajectory.name, decisive ? std::to_string(decisive->ranks[i]) : "-", rpe_of(trajectory),
                    value_of(evaluation.mom), value_of(evaluation.mpv), value_of(evaluation.mme),
                    value_of(evaluation.omme)});
  }
  return in_columns(rows);
}

std::string p_value_text(double p) { return p < 0.001 ? "p < 0.001" : fmt::format("p = {:.3f}", p); }

/// "a is better than b by 0.41 m [0.3, 0.5], p = 0.004, 10 of 10 windows".
std::string sentence_of(const PairedDifference& pair, std::string_view unit, const Comparison& comparison) {
  const auto name = [&](std::size_t i) { return comparison.trajectories[i].name; };
  if (!pair.mean_difference) {
    return fmt::format("{} and {}: no window in which both have a value", name(pair.first), name(pair.second));
  }
  const bool is_first = pair.better.value_or(*pair.mean_difference <= 0 ? pair.first : pair.second) == pair.first;
  const std::size_t num_better = is_first ? pair.num_first_better : pair.num_windows - pair.num_first_better;
  std::string text = is_first ? name(pair.first) : name(pair.second);
  text += pair.better ? " is better than " : " may be better than ";
  text += is_first ? name(pair.second) : name(pair.first);
  text += fmt::format(" by {:.3g} {} a window", std::abs(*pair.mean_difference), unit);
  if (pair.interval) {
    const Interval& interval = *pair.interval;
    const Interval shown = is_first ? Interval{-interval.high, -interval.low} : interval;
    text += fmt::format(" [{:.3g}, {:.3g}]", shown.low, shown.high);
  }
  text += fmt::format(", {}, {} of {} windows", p_value_text(*pair.p_adjusted), num_better, pair.num_windows);
  if (!pair.windows_can_tell) text += pair.better ? "; their intervals do not meet" : "; too few windows to tell";
  return text;
}

std::string pairs_by(const MetricComparison& metric, const Comparison& comparison) {
  std::string text = fmt::format("\nBy {}:\n", title_of(metric.metric));
  for (const PairedDifference& pair : metric.pairs) {
    text += "  " + sentence_of(pair, unit_of(metric.metric), comparison) + "\n";
  }
  return text;
}

/// What decides comes first.
std::string pairs_of(const Comparison& comparison, const MetricComparison* decisive) {
  std::string text = decisive ? pairs_by(*decisive, comparison) : "";
  for (const MetricComparison& metric : comparison.by_metric) {
    if (&metric != decisive) text += pairs_by(metric, comparison);
  }
  return text;
}

std::string conclusion(const Comparison& comparison) {
  if (!comparison.decisive) return "The trajectories cannot be compared:";
  std::string text = "Best by ";
  text += title_of(*comparison.decisive);
  text += ": ";
  for (std::size_t i = 0; i < comparison.best.size(); ++i) {
    if (i > 0) text += ", ";
    text += comparison.trajectories[comparison.best[i]].name;
  }
  if (comparison.best.size() > 1) text += " (they cannot be told apart)";
  return text + ".";
}

}  // namespace

std::string comparison_table(const Comparison& comparison, bool color) {
  const EvaluationSettings& settings = comparison.settings.evaluation;
  const ComparedTrajectory& any = comparison.trajectories.front();
  std::string text =
      fmt::format("{} trajectories of {} scans, {} windows of {} scans\n\n", comparison.trajectories.size(),
                  any.evaluation.inputs.num_scans, any.evaluation.windows.size(), settings.window.value_or(0));
  const MetricComparison* decisive = decisive_of(comparison);
  text += rows_of(comparison, decisive);
  if (comparison.adjusted_from) {
    text += fmt::format("\n  RPE: against the poses in which the scans agree, from {}",
                        comparison.trajectories[*comparison.adjusted_from].name);
    if (comparison.adjusted_agreement_m) {
      text +=
          fmt::format("; those from the others differ by {:.2g} mm at most", 1000 * *comparison.adjusted_agreement_m);
    }
    text += "\n";
  }
  text += pairs_of(comparison, decisive);
  text += "\n" + (color ? fmt::format("\033[1m{}\033[0m", conclusion(comparison)) : conclusion(comparison)) + "\n";
  for (const std::string& reason : comparison.verdict.reasons) text += "  - " + reason + "\n";
  return text;
}

}  // namespace trysquare::app
