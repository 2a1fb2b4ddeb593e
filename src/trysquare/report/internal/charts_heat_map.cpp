// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/report/internal/charts.h"
#include "trysquare/report/internal/charts_axis.h"
#include "trysquare/report/internal/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace trysquare::internal {
namespace {

constexpr double kLeft = 52;
constexpr double kTop = 50;
constexpr double kPlotWidth = 418;
constexpr double kMinPlotHeight = 110;
constexpr std::size_t kMaxWindowsWithTitles = 2000;

using Position = std::array<double, 3>;

std::vector<Position> positions_of(const Json& evaluation) {
  std::vector<Position> positions;
  if (!has(evaluation, "trajectory")) return positions;
  for (const Json& position : evaluation.at("trajectory").at("positions_in_map_m")) {
    positions.push_back({position.at(0).get<double>(), position.at(1).get<double>(), position.at(2).get<double>()});
  }
  return positions;
}

/// The two map axes of the largest extents, the larger one to the right, seen against the third: a turn to the left
/// stays one, which needs the axis to the right to run backwards in three of six cases.
struct Projection {
  std::size_t right = 0;
  std::size_t up = 1;
  bool is_right_reversed = false;
  Position low = {};
  Position extent = {};
};

Projection projection_of(const std::vector<Position>& positions) {
  Projection projection;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto less = [axis](const Position& a, const Position& b) { return a[axis] < b[axis]; };
    const auto [low, high] = std::minmax_element(positions.begin(), positions.end(), less);
    projection.low[axis] = (*low)[axis];
    projection.extent[axis] = (*high)[axis] - (*low)[axis];
  }
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return projection.extent[a] > projection.extent[b]; });
  projection.right = order[0];
  projection.up = order[1];
  projection.is_right_reversed = (projection.right + 1) % 3 != projection.up;
  return projection;
}

struct MapView {
  SvgBox plot;
  AxisScale x;
  AxisScale y;
  std::vector<SvgPoint> places;  ///< Of the positions.
};

/// As many metres per unit to the right as up; the range of the shorter axis grows until the box is full.
MapView view_of(const std::vector<Position>& positions, const Projection& projection) {
  constexpr double kRoom = 1.14;
  const double right_extent = projection.extent[projection.right];
  const double up_extent = projection.extent[projection.up];
  const double wide = right_extent > 0 ? right_extent : 1;
  const double height = std::max(kPlotWidth * up_extent / wide, kMinPlotHeight);
  const double metres_per_unit = kRoom * wide / kPlotWidth;

  const auto range = [&](std::size_t axis, double length) {
    const double middle = projection.low[axis] + projection.extent[axis] / 2;
    return std::pair(middle - length * metres_per_unit / 2, middle + length * metres_per_unit / 2);
  };
  const auto [left, right] = range(projection.right, kPlotWidth);
  const auto [bottom, top] = range(projection.up, height);
  MapView view{.plot = {kLeft, kTop, kPlotWidth, height},
               .x = {left, right, kLeft, kLeft + kPlotWidth},
               .y = {bottom, top, kTop + height, kTop},
               .places = {}};
  if (projection.is_right_reversed) std::swap(view.x.place_of_low, view.x.place_of_high);
  for (const Position& position : positions) {
    view.places.push_back({view.x.place(position[projection.right]), view.y.place(position[projection.up])});
  }
  return view;
}

std::string axes(const MapView& view, const Projection& projection) {
  const char* const names = "xyz";
  const double bottom = view.plot.top + view.plot.height;
  std::string body = y_axis(view.y, ticks(view.y.low, view.y.high, std::max(2.0, view.plot.height / 60)), view.plot);
  body += x_axis(view.x, ticks(view.x.low, view.x.high, 6), view.plot, true);
  body += svg_line({kLeft, kTop}, {kLeft, bottom}, "axis");
  body += svg_text({kLeft + kPlotWidth, bottom + 32}, "axis-name", "end",
                   fmt::format("{} in the map frame [m]{}", names[projection.right],
                               projection.is_right_reversed ? ", growing to the left" : ""));
  body += svg_text({kLeft, kTop - 8}, "axis-name", "middle", fmt::format("{} [m]", names[projection.up]));
  return body;
}

/// Poses [begin, end] of the path that the i-th window colors.
std::pair<std::size_t, std::size_t> colored_part(const std::vector<Window>& windows, std::size_t i) {
  const auto boundary = [&](std::size_t k) {  // between the windows k and k + 1
    return (windows[k].first + windows[k].last + windows[k + 1].first + windows[k + 1].last + 2) / 4;
  };
  const Window& window = windows[i];
  const std::size_t begin = i > 0 ? std::clamp(boundary(i - 1), window.first, window.last) : window.first;
  if (i + 1 == windows.size()) return {begin, window.last};
  // the step from one window to the next belongs to the earlier one
  const bool touches_next = windows[i + 1].first <= window.last + 1;
  const std::size_t end = std::min(boundary(i), touches_next ? window.last + 1 : window.last);
  return {begin, std::max(begin, end)};
}

struct ColorRange {
  double low = 0;
  double high = 0;

  double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

ColorRange color_range(const WindowSeries& series) {
  std::vector<double> defined;
  for (const std::optional<double>& value : series.values) {
    if (value) defined.push_back(*value);
  }
  const auto [low, high] = std::minmax_element(defined.begin(), defined.end());
  return {*low, *high};
}

std::string segments(const MapView& view, const std::vector<Window>& windows, const WindowSeries& series) {
  const ColorRange colors = color_range(series);
  std::string casing;
  std::string colored;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    if (windows[i].last >= view.places.size()) {
      throw InvalidArgument(fmt::format("JSON: window [{}, {}] reaches beyond the trajectory of {} poses",
                                        windows[i].first, windows[i].last, view.places.size()));
    }
    const auto [begin, end] = colored_part(windows, i);
    const auto at = [&](std::size_t index) { return view.places.begin() + static_cast<std::ptrdiff_t>(index); };
    const std::size_t stop = std::min(end + 1, view.places.size());
    const std::vector<SvgPoint> part(at(begin), at(stop));
    const std::string value =
        series.values[i] ? quantity(*series.values[i], series.unit) : "undefined: " + series.reasons[i];
    const bool has_title = windows.size() <= kMaxWindowsWithTitles;
    const std::string title = has_title ? fmt::format("{}: {} {}", window_label(windows[i]), series.name, value) : "";
    if (series.values[i]) {
      casing += svg_path(part, "casing", "", "");
      colored += svg_path(part, "segment", color_of(colors.share(*series.values[i])), title);
    } else {
      colored += svg_path(part, "undefined", "", title);
    }
  }
  return casing + colored;
}

std::string legend(const WindowSeries& series) {
  constexpr int kNumSteps = 60;
  constexpr SvgBox kBar = {.left = 250, .top = 4, .width = 220, .height = 10};
  const ColorRange colors = color_range(series);
  const AxisUnit unit = axis_unit(series);
  std::string body = svg_text({0, 13}, "name", "start", fmt::format("{} [{}]", series.name, unit.label));
  const double step = kBar.width / kNumSteps;
  for (int i = 0; i < kNumSteps; ++i) {
    const double share = colors.high > colors.low ? (i + 0.5) / kNumSteps : 0.5;
    const double overlap = i + 1 < kNumSteps ? 0.5 : 0;  // no hairlines between the steps
    body += svg_box({kBar.left + i * step, kBar.top, step + overlap, kBar.height}, "color", color_of(share), "");
  }
  const double baseline = kBar.top + kBar.height + 13;
  if (colors.high > colors.low) {
    body += svg_text({kBar.left, baseline}, "tick", "start", quantity(colors.low * unit.factor));
    body += svg_text({kBar.left + kBar.width / 2, baseline}, "tick", "middle",
                     quantity((colors.low + colors.high) / 2 * unit.factor));
    body += svg_text({kBar.left + kBar.width, baseline}, "tick", "end", quantity(colors.high * unit.factor));
  } else {
    body += svg_text({kBar.left + kBar.width / 2, baseline}, "tick", "middle", quantity(colors.low * unit.factor));
  }
  const bool has_gap = std::any_of(series.values.begin(), series.values.end(), [](const auto& v) { return !v; });
  if (has_gap) {
    body += svg_line({0, 25}, {24, 25}, "undefined");
    body += svg_text({30, 29}, "tick", "start", "undefined");
  }
  return body;
}

/// A loop ends where it starts: the end fits into the ring of the start, one label is above its mark, the other below.
std::string marks(const MapView& view) {
  const auto label = [&](SvgPoint at, double offset, const char* text) {
    const double share = (at.x - kLeft) / kPlotWidth;
    const char* const anchor = share < 0.15 ? "start" : share > 0.85 ? "end" : "middle";
    return svg_text({at.x, at.y + offset}, "mark-label", anchor, text);
  };
  const SvgPoint start = view.places.front();
  const SvgPoint end = view.places.back();
  return svg_circle(start, 7, "start", "start: first scan") + label(start, -13, "start") +
         svg_box({end.x - 4, end.y - 4, 8, 8}, "end", "", "end: last scan") + label(end, 21, "end");
}

}  // namespace

std::optional<Drawing> heat_map(const Json& evaluation, const std::vector<Window>& windows,
                                const WindowSeries& series) {
  const std::vector<Position> positions = positions_of(evaluation);
  if (positions.empty()) return std::nullopt;
  const Projection projection = projection_of(positions);
  const MapView view = view_of(positions, projection);
  Drawing drawing{.width = kFigureWidth,
                  .height = view.plot.top + view.plot.height + 40,
                  .title = series.name + " along the trajectory",
                  .body = ""};
  drawing.body += legend(series);
  drawing.body += axes(view, projection);
  drawing.body += svg_path(view.places, "path", "", "");
  drawing.body += segments(view, windows, series);
  drawing.body += marks(view);
  return drawing;
}

}  // namespace trysquare::internal
