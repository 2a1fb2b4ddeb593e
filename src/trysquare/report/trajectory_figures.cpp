// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/trajectory_figures.h"

#include "trysquare/report/internal/charts.h"
#include "trysquare/report/internal/charts_axis.h"
#include "trysquare/report/internal/format.h"
#include "trysquare/report/internal/svg.h"
#include "trysquare/trajectory/error_unit.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>

namespace trysquare {
namespace {

using internal::AxisScale;
using internal::Drawing;
using internal::SvgBox;
using internal::SvgPoint;

constexpr double kLeft = 52;
constexpr double kWidth = 418;
constexpr std::size_t kMaxParts = 400;

std::string name_of_error(const TrajectoryErrors& errors) {
  return fmt::format("{} {}", errors.pairs.empty() ? "APE" : "RPE", name_of(errors.relation));
}

/// Indices of the smallest and the largest value of each of kMaxParts parts, in their order; all of fewer values.
std::vector<std::size_t> extremes(const std::vector<double>& values) {
  std::vector<std::size_t> indices;
  if (values.size() <= 2 * kMaxParts) {
    indices.resize(values.size());
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    return indices;
  }
  for (std::size_t part = 0; part < kMaxParts; ++part) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(part * values.size() / kMaxParts);
    const auto end = values.begin() + static_cast<std::ptrdiff_t>((part + 1) * values.size() / kMaxParts);
    const auto [low, high] = std::minmax_element(begin, end);
    indices.push_back(static_cast<std::size_t>(std::min(low, high) - values.begin()));
    if (low != high) indices.push_back(static_cast<std::size_t>(std::max(low, high) - values.begin()));
  }
  return indices;
}

/// Errors over something that grows along the run.
Drawing line_chart(const TrajectoryErrors& errors, const std::vector<double>& abscissa, const std::string& axis_name) {
  constexpr SvgBox kPlot = {.left = kLeft, .top = 28, .width = kWidth, .height = 150};
  const auto [first, last] = std::minmax_element(abscissa.begin(), abscissa.end());
  const double largest = errors.statistics.max > 0 ? 1.08 * errors.statistics.max : 1;
  const AxisScale x{*first, *last > *first ? *last : *first + 1, kPlot.left, kPlot.left + kPlot.width};
  const AxisScale y{0, largest, kPlot.top + kPlot.height, kPlot.top};
  std::vector<SvgPoint> places;
  for (const std::size_t i : extremes(errors.errors)) {
    places.push_back({x.place(abscissa[i]), y.place(errors.errors[i])});
  }
  Drawing drawing{.width = internal::kFigureWidth,
                  .height = 218,
                  .title = name_of_error(errors) + " over " + axis_name,
                  .body = ""};
  drawing.body +=
      internal::svg_text({0, 13}, "name", "start", fmt::format("{} [{}]", name_of_error(errors), unit_of(errors)));
  drawing.body += internal::y_axis(y, internal::ticks(y.low, y.high, 5.5), kPlot);
  drawing.body += internal::x_axis(x, internal::ticks(x.low, x.high, 8), kPlot, false);
  drawing.body +=
      internal::svg_text({kPlot.left + kPlot.width, kPlot.top + kPlot.height + 32}, "axis-name", "end", axis_name);
  drawing.body += internal::svg_path(places, "series", "", "");
  return drawing;
}

/// The world's axis to the right and the one upwards: those of the two largest extents, right-handed as seen.
std::array<Eigen::Index, 2> axes_of(const Eigen::AlignedBox3d& box) {
  Eigen::Index flat = 0;
  box.sizes().minCoeff(&flat);
  return {(flat + 1) % 3, (flat + 2) % 3};
}

std::string color_bar(const TrajectoryErrors& errors) {
  constexpr int kNumSteps = 60;
  constexpr SvgBox kBar = {.left = 250, .top = 4, .width = 220, .height = 10};
  std::string body =
      internal::svg_text({0, 13}, "name", "start", fmt::format("{} [{}]", name_of_error(errors), unit_of(errors)));
  const double step = kBar.width / kNumSteps;
  for (int i = 0; i < kNumSteps; ++i) {
    const double overlap = i + 1 < kNumSteps ? 0.5 : 0;  // no hairlines between the steps
    body += internal::svg_box({kBar.left + i * step, kBar.top, step + overlap, kBar.height}, "color",
                              internal::color_of((i + 0.5) / kNumSteps), "");
  }
  const double baseline = kBar.top + kBar.height + 13;
  body += internal::svg_text({kBar.left, baseline}, "tick", "start", internal::quantity(errors.statistics.min));
  body +=
      internal::svg_text({kBar.left + kBar.width, baseline}, "tick", "end", internal::quantity(errors.statistics.max));
  return body;
}

/// Without those that are nearly where the one before is, which the thickness of a line hides; the last one stays.
std::vector<SvgPoint> thinned(const std::vector<SvgPoint>& places) {
  constexpr double kApart = 0.2;
  std::vector<SvgPoint> kept;
  for (const SvgPoint& place : places) {
    const bool is_near = !kept.empty() && std::hypot(place.x - kept.back().x, place.y - kept.back().y) < kApart;
    if (!is_near) kept.push_back(place);
  }
  if (!places.empty()) kept.push_back(places.back());
  return kept;
}

/// The estimate in pieces, each in the color of its largest error.
std::string colored_path(const TrajectoryErrors& errors, const std::vector<SvgPoint>& places) {
  const double low = errors.statistics.min;
  const double range = errors.statistics.max - low;
  const std::size_t num_parts = std::min(kMaxParts, places.size());
  std::string body;
  for (std::size_t part = 0; part < num_parts; ++part) {
    const std::size_t begin = part * places.size() / num_parts;
    const std::size_t end = std::min((part + 1) * places.size() / num_parts, places.size() - 1);
    const auto at = [](const auto& values, std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
    const double largest = *std::max_element(at(errors.errors, begin), at(errors.errors, std::max(end, begin + 1)));
    const double share = range > 0 ? (largest - low) / range : 0.5;
    const std::vector<SvgPoint> piece(at(places, begin), at(places, end + 1));
    body += internal::svg_path(thinned(piece), "segment", internal::color_of(share), "");
  }
  return body;
}

/// The reference thin and grey, the estimate on it; the same scale on both axes.
Drawing error_map(const TrajectoryErrors& errors, const ErrorSeries& series, const Trajectory& reference) {
  constexpr double kTop = 50;
  constexpr double kMinHeight = 110;
  constexpr double kRoom = 1.14;
  Eigen::AlignedBox3d box;
  for (const Pose& pose : reference.world_from_scan) box.extend(pose.translation);
  for (const Eigen::Vector3d& position : series.positions_in_reference_world) box.extend(position);
  const auto [right, up] = axes_of(box);
  const double wide = std::max({box.sizes()[right], 0.1 * box.sizes()[up], 1e-9});
  const double height = std::max(kWidth * box.sizes()[up] / wide, kMinHeight);
  const double metres_per_unit = kRoom * wide / kWidth;
  const auto scale = [&](Eigen::Index axis, double length, double place_of_low, double place_of_high) {
    const double half_m = length * metres_per_unit / 2;
    return AxisScale{box.center()[axis] - half_m, box.center()[axis] + half_m, place_of_low, place_of_high};
  };
  const AxisScale x = scale(right, kWidth, kLeft, kLeft + kWidth);
  const AxisScale y = scale(up, height, kTop + height, kTop);
  const SvgBox plot{kLeft, kTop, kWidth, height};
  const auto place = [&, r = right, u = up](const Eigen::Vector3d& p) {
    return SvgPoint{x.place(p[r]), y.place(p[u])};
  };
  std::vector<SvgPoint> truth;
  std::vector<SvgPoint> places;
  for (const Pose& pose : reference.world_from_scan) truth.push_back(place(pose.translation));
  for (const Eigen::Vector3d& position : series.positions_in_reference_world) places.push_back(place(position));

  const char* const names = "xyz";
  Drawing drawing{.width = internal::kFigureWidth,
                  .height = kTop + height + 40,
                  .title = name_of_error(errors) + " along the trajectory",
                  .body = ""};
  drawing.body += color_bar(errors);
  drawing.body += internal::y_axis(y, internal::ticks(y.low, y.high, std::max(2.0, height / 60)), plot);
  drawing.body += internal::x_axis(x, internal::ticks(x.low, x.high, 6), plot, true);
  drawing.body +=
      internal::svg_text({kLeft + kWidth, kTop + height + 32}, "axis-name", "end", fmt::format("{} [m]", names[right]));
  drawing.body += internal::svg_text({kLeft, kTop - 8}, "axis-name", "middle", fmt::format("{} [m]", names[up]));
  drawing.body += internal::svg_path(thinned(truth), "path", "", "");
  drawing.body += colored_path(errors, places);
  return drawing;
}

}  // namespace

std::vector<Figure> error_figures(const TrajectoryErrors& errors, const ErrorSeries& series,
                                  const Trajectory& reference) {
  std::vector<Figure> figures;
  figures.push_back({"error_map.svg", internal::standalone_svg(error_map(errors, series, reference))});
  figures.push_back({"error_over_distance.svg",
                     internal::standalone_svg(line_chart(errors, series.reference_distances_m, "distance [m]"))});
  if (!series.seconds_from_start.empty()) {
    figures.push_back(
        {"error_over_time.svg", internal::standalone_svg(line_chart(errors, series.seconds_from_start, "time [s]"))});
  }
  return figures;
}

}  // namespace trysquare
