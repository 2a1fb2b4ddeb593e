// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/charts.h"

#include "trysquare/report/internal/charts_axis.h"
#include "trysquare/report/internal/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace trysquare::internal {
namespace {

constexpr SvgBox kPlot = {.left = 52, .top = 28, .width = 418, .height = 96};
constexpr double kChartHeight = 164;
constexpr std::size_t kMaxWindowsWithDots = 80;  // beyond, dots touch and hide the line
constexpr std::size_t kMaxWindowsWithTitles = 2000;

double middle_of(const Window& window) {
  return (static_cast<double>(window.first) + static_cast<double>(window.last)) / 2;
}

AxisScale scan_axis(const std::vector<Window>& windows) {
  std::size_t first = windows.front().first;
  std::size_t last = windows.front().last;
  for (const Window& window : windows) {
    first = std::min(first, window.first);
    last = std::max(last, window.last);
  }
  // half a scan on each side: a band covers its scans, and one scan alone still has a width
  return {static_cast<double>(first) - 0.5, static_cast<double>(last) + 0.5, kPlot.left, kPlot.left + kPlot.width};
}

AxisScale value_axis(const WindowSeries& series, double factor) {
  double low = 0;
  double high = 0;
  bool is_first = true;
  for (const std::optional<double>& value : series.values) {
    if (!value) continue;
    low = is_first ? *value * factor : std::min(low, *value * factor);
    high = is_first ? *value * factor : std::max(high, *value * factor);
    is_first = false;
  }
  if (series.starts_at_zero) low = std::min(low, 0.0);
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low <= 1e-6 * size) {  // all the same: no range to show
    const double room = size > 0 ? 0.1 * size : 1;
    return {low - room, high + room, kPlot.top + kPlot.height, kPlot.top};
  }
  const double room = 0.08 * (high - low);
  const double lowest = series.starts_at_zero && low == 0 ? 0 : low - room;
  return {lowest, high + room, kPlot.top + kPlot.height, kPlot.top};
}

std::string tooltip(const Window& window, const WindowSeries& series, std::size_t i) {
  const std::string value =
      series.values[i] ? quantity(*series.values[i], series.unit) : "undefined: " + series.reasons[i];
  return fmt::format("{}: {} {}", window_label(window), series.name, value);
}

std::string gaps(const std::vector<Window>& windows, const WindowSeries& series, const AxisScale& x) {
  std::string body;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    if (series.values[i]) continue;
    const double left = x.place(static_cast<double>(windows[i].first) - 0.5);
    const double right = x.place(static_cast<double>(windows[i].last) + 0.5);
    body += svg_box({left, kPlot.top, right - left, kPlot.height}, "gap", "", tooltip(windows[i], series, i));
  }
  return body;
}

/// The line breaks where a window is undefined.
std::string lines(const std::vector<SvgPoint>& places, const WindowSeries& series) {
  std::string body;
  std::vector<SvgPoint> run;
  for (std::size_t i = 0; i <= places.size(); ++i) {
    if (i < places.size() && series.values[i]) {
      run.push_back(places[i]);
    } else if (!run.empty()) {
      body += svg_path(run, "series", "", "");
      run.clear();
    }
  }
  return body;
}

}  // namespace

Drawing window_chart(const std::vector<Window>& windows, const WindowSeries& series) {
  const AxisUnit unit = axis_unit(series);
  const AxisScale x = scan_axis(windows);
  const AxisScale y = value_axis(series, unit.factor);
  std::vector<SvgPoint> places;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    places.push_back({x.place(middle_of(windows[i])), y.place(series.values[i].value_or(0) * unit.factor)});
  }

  Drawing drawing{.width = kFigureWidth, .height = kChartHeight, .title = series.name + " of the windows", .body = ""};
  drawing.body += svg_text({0, 13}, "name", "start", fmt::format("{} [{}]", series.name, unit.label));
  drawing.body += gaps(windows, series, x);
  drawing.body += y_axis(y, ticks(y.low, y.high, 5.5), kPlot);
  drawing.body += x_axis(x, whole_ticks(x.low, x.high, 8), kPlot, false);
  drawing.body += svg_text({kPlot.left + kPlot.width, kPlot.top + kPlot.height + 32}, "axis-name", "end", "scan");
  drawing.body += lines(places, series);
  const bool has_dots = windows.size() <= kMaxWindowsWithDots;
  const bool has_titles = windows.size() <= kMaxWindowsWithTitles;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const bool is_drawn = series.values[i] && (has_dots || series.is_limited[i]);
    if (!is_drawn) continue;
    drawing.body += svg_circle(places[i], 3.2, series.is_limited[i] ? "hollow" : "dot",
                               has_titles ? tooltip(windows[i], series, i) : "");
  }
  return drawing;
}

Drawing stacked_window_charts(const WindowTable& table) {
  Drawing stack{.width = kFigureWidth, .height = 0, .title = "The windows over the scans", .body = ""};
  for (const WindowSeries& series : table.series) {
    if (!has_value(series)) continue;
    const Drawing chart = window_chart(table.windows, series);
    stack.body += fmt::format("<g transform=\"translate(0 {})\">\n{}</g>\n", stack.height, chart.body);
    stack.height += chart.height + 10;
  }
  return stack;
}

}  // namespace trysquare::internal
