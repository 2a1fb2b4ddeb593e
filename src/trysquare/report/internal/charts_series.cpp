// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/charts_series.h"

#include "trysquare/core/error.h"
#include "trysquare/report/internal/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trysquare::internal {
namespace {

void add_value(WindowSeries& series, const Json& object, const std::string& key) {
  const bool is_defined = has(object, key);
  series.values.push_back(is_defined ? std::optional<double>(object.at(key).get<double>()) : std::nullopt);
  series.reasons.push_back(is_defined ? "" : reason_of(object, key));
}

WindowSeries series_of(const Json& windows, WindowSeries series, const std::string& json_key) {
  const bool is_orthogonal = series.key == "mom" || series.key == "omme";
  for (const Json& window : windows) {
    add_value(series, window, json_key);
    const bool is_limited =
        has(window, "follows_trajectory_error") && !window.at("follows_trajectory_error").get<bool>();
    const bool is_isolated = has(window, "meaningful") && !window.at("meaningful").get<bool>();
    series.is_limited.push_back(is_isolated || (is_orthogonal && is_limited));
  }
  return series;
}

WindowSeries overlap_series(const Json& windows) {
  WindowSeries series{.key = "overlap", .name = "Overlap", .unit = "scans", .starts_at_zero = true};
  for (const Json& window : windows) {
    add_value(series, window.at("overlap"), "scans_per_neighborhood_mean");
    series.is_limited.push_back(false);
  }
  return series;
}

}  // namespace

WindowTable window_table(const Json& evaluation) {
  const Json& windows = evaluation.at("windows");
  WindowTable table;
  for (const Json& window : windows) {
    table.windows.push_back({window.at("first").get<std::size_t>(), window.at("last").get<std::size_t>()});
    const Window& added = table.windows.back();
    if (added.last < added.first) {
      throw InvalidArgument(fmt::format("JSON: window [{}, {}]: expected first <= last", added.first, added.last));
    }
  }
  const Json& metrics = evaluation.at("metrics");
  const auto add_metric = [&](const std::string& key, const char* name, const char* unit, bool starts_at_zero) {
    if (!has(metrics, key)) return;
    table.series.push_back(
        series_of(windows, {.key = key, .name = name, .unit = unit, .starts_at_zero = starts_at_zero}, key));
  };
  add_metric("mom", "MOM", "m2", true);
  if (has(evaluation, "reference")) {
    table.series.push_back(
        series_of(windows, {.key = "rpe", .name = "RPE, reference", .unit = "m", .starts_at_zero = true}, "rpe_m"));
  }
  add_metric("mpv", "MPV", "m2", true);
  add_metric("mme", "MME", "nats", false);
  add_metric("omme", "OMME", "nats", false);
  table.series.push_back(overlap_series(windows));
  return table;
}

bool has_value(const WindowSeries& series) {
  return std::any_of(series.values.begin(), series.values.end(), [](const auto& value) { return value.has_value(); });
}

std::string window_label(const Window& window) { return fmt::format("scans {}–{}", window.first, window.last); }

AxisUnit axis_unit(const WindowSeries& series) {
  double largest = 0;
  for (const std::optional<double>& value : series.values) largest = std::max(largest, std::abs(value.value_or(0)));
  const std::string symbol = unit_symbol(series.unit);
  if (largest == 0 || (largest >= 0.1 && largest < 1e5)) return {1, symbol};
  const int exponent = std::max(-300, 3 * static_cast<int>(std::floor(std::log10(largest) / 3)));
  const double factor = std::pow(10.0, -exponent);
  if (series.unit == "m" && exponent == -3) return {factor, "mm"};
  return {factor, power_of_ten(exponent) + "\u00A0" + symbol};
}

}  // namespace trysquare::internal
