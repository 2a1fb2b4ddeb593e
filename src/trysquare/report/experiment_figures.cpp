// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/experiment_figures.h"

#include "trysquare/core/error.h"
#include "trysquare/report/internal/charts.h"
#include "trysquare/report/internal/charts_axis.h"
#include "trysquare/report/internal/format.h"
#include "trysquare/report/internal/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

namespace trysquare {
namespace {

using internal::AxisScale;
using internal::Drawing;
using internal::SvgBox;
using internal::SvgPoint;

constexpr double kWidth = 2 * internal::kFigureWidth;
constexpr std::array<const char*, 5> kColors = {"#2a6f97", "#d1495b", "#2e8b3d", "#8d5fa8", "#b3791f"};
constexpr std::array<const char*, 4> kScatterMetrics = {"mme", "mpv", "omme", "mom"};

std::string_view title_of(Coefficient coefficient) {
  switch (coefficient) {
    case Coefficient::kPearson:
      return "Pearson";
    case Coefficient::kSpearman:
      return "Spearman";
    case Coefficient::kKendallTauB:
      break;
  }
  return "Kendall";
}

/// "mom_sum_of_medians_paper": {"MOM", "med.", "paper"}: labels stand below each other, for want of width.
std::vector<std::string> label_of(const std::string& metric) {
  static const std::string kSum = "_sum_of_medians";
  const std::size_t end = metric.find('_');
  std::string name = metric.substr(0, end);
  for (char& letter : name) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  std::string rest = end == std::string::npos ? "" : metric.substr(end);
  std::vector<std::string> lines = {name};
  if (rest.starts_with(kSum)) {
    lines.emplace_back("med.");
    rest.erase(0, kSum.size());
  }
  if (!rest.empty()) lines.push_back(rest.substr(1));
  return lines;
}

std::string rotation_label(double sigma_rad) {
  if (sigma_rad == 0) return "";
  return fmt::format(", {:.4g}° rotation noise", sigma_rad * 180 / std::numbers::pi);
}

/// Values of one metric and one number of poses over the environments, ascending.
struct Spread {
  std::size_t num_poses = 0;
  std::vector<double> values;

  double quantile(double share) const {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], place - static_cast<double>(below));
  }
  double mean() const {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
};

/// One panel: spreads of every metric.
struct Panel {
  std::string title;
  std::vector<std::string> metrics;
  std::vector<std::vector<Spread>> spreads;  ///< Metric by metric.

  Spread& at(std::size_t metric, std::size_t num_poses) {
    std::vector<Spread>& all = spreads[metric];
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Spread& spread) { return spread.num_poses == num_poses; });
    if (found != all.end()) return *found;
    return all.emplace_back(Spread{num_poses, {}});
  }
};

using Units = std::span<const ExperimentUnit>;
using Correlations = std::span<const std::vector<MetricCorrelation>>;

bool is_same_scene(const ExperimentUnit& a, const ExperimentUnit& b) {
  return a.group == b.group && a.rotation_sigma_rad == b.rotation_sigma_rad;
}

Panel panel_of(Units units, Correlations correlations, const ExperimentUnit& scene, std::size_t coefficient) {
  Panel panel{.title = fmt::format("{}: {}{}", title_of(kCoefficients.at(coefficient)), scene.group,
                                   rotation_label(scene.rotation_sigma_rad)),
              .metrics = {},
              .spreads = {}};
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!is_same_scene(units[i], scene)) continue;
    for (std::size_t m = 0; m < correlations[i].size(); ++m) {
      if (m == panel.metrics.size()) {
        panel.metrics.push_back(correlations[i][m].metric);
        panel.spreads.emplace_back();
      }
      Spread& spread = panel.at(m, units[i].num_poses);
      const std::optional<double> value = correlations[i][m].coefficients.at(coefficient).value;
      if (value) spread.values.push_back(*value);
    }
  }
  for (std::vector<Spread>& metric : panel.spreads) {
    for (Spread& spread : metric) std::sort(spread.values.begin(), spread.values.end());
  }
  return panel;
}

AxisScale correlation_axis(const Panel& panel, const SvgBox& box) {
  double lowest = 1;
  for (const std::vector<Spread>& metric : panel.spreads) {
    for (const Spread& spread : metric) {
      if (!spread.values.empty()) lowest = std::min(lowest, spread.values.front());
    }
  }
  const double low = std::max(-1.0, std::floor((lowest - 0.02) * 10) / 10);
  return {low, 1.0 + 0.02 * (1 - low), box.top + box.height, box.top};
}

std::string body_of(const Spread& spread, double x, const AxisScale& y, const char* color, const std::string& title) {
  constexpr double kHalfBox = 3.5;
  if (spread.values.empty()) return "";
  const double top = y.place(spread.quantile(0.75));
  const double bottom = y.place(spread.quantile(0.25));
  std::string body =
      internal::svg_path({{x, y.place(spread.values.front())}, {x, y.place(spread.values.back())}}, "cloud", color, "");
  body += internal::svg_box({x - kHalfBox, top, 2 * kHalfBox, std::max(bottom - top, 1.0)}, "color", color, title);
  return body + internal::svg_circle({x, y.place(spread.mean())}, 2.2, "hollow", title);
}

std::string body_of(const Panel& panel, const SvgBox& box) {
  const AxisScale y = correlation_axis(panel, box);
  std::string body = internal::svg_text({box.left - 40, box.top - 12}, "name", "start", panel.title);
  body += internal::y_axis(y, internal::ticks(y.low, 1, 5), box);
  const double width = box.width / static_cast<double>(panel.metrics.size());
  for (std::size_t m = 0; m < panel.metrics.size(); ++m) {
    const double left = box.left + width * static_cast<double>(m);
    const std::vector<Spread>& spreads = panel.spreads[m];
    for (std::size_t n = 0; n < spreads.size(); ++n) {
      const double x = left + width * (static_cast<double>(n) + 1) / (static_cast<double>(spreads.size()) + 1);
      const std::string title = spreads[n].values.empty()
                                    ? ""
                                    : fmt::format("{}, {} poses: mean {:.3f} of {} environments", panel.metrics[m],
                                                  spreads[n].num_poses, spreads[n].mean(), spreads[n].values.size());
      body += body_of(spreads[n], x, y, kColors.at(n % kColors.size()), title);
    }
    double baseline = box.top + box.height + 15;
    for (const std::string& line : label_of(panel.metrics[m])) {
      body += internal::svg_text({left + width / 2, baseline}, "tick", "middle", line);
      baseline += 12;
    }
  }
  return body;
}

std::string legend(Units units) {
  std::vector<std::size_t> lengths;
  for (const ExperimentUnit& unit : units) {
    if (std::find(lengths.begin(), lengths.end(), unit.num_poses) == lengths.end()) lengths.push_back(unit.num_poses);
  }
  std::string body;
  for (std::size_t n = 0; n < lengths.size(); ++n) {
    const double x = 12 + 90 * static_cast<double>(n);
    body += internal::svg_box({x, 4, 10, 10}, "color", kColors.at(n % kColors.size()), "");
    body += internal::svg_text({x + 15, 13}, "tick", "start", fmt::format("{} poses", lengths[n]));
  }
  return body +
         internal::svg_text({kWidth, 13}, "tick", "end", "line: all environments, box: the middle half, circle: mean");
}

/// Finite values of a column and where they lie; a little room on both sides.
AxisScale axis_of(const std::vector<double>& values, double factor, double place_of_low, double place_of_high) {
  double low = 0;
  double high = 0;
  bool is_first = true;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = is_first ? value * factor : std::min(low, value * factor);
    high = is_first ? value * factor : std::max(high, value * factor);
    is_first = false;
  }
  const double room = high > low ? 0.06 * (high - low) : std::max(std::abs(high), 1.0) * 0.1;
  return {low - room, high + room, place_of_low, place_of_high};
}

/// A power of ten that brings the largest to 1 … 1000.
int exponent_for(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  if (largest == 0 || (largest >= 0.1 && largest < 1000)) return 0;
  return 3 * static_cast<int>(std::floor(std::log10(largest) / 3));
}

std::string unit_label(const char* unit, int exponent) {
  return exponent == 0 ? std::string(unit) : fmt::format("{} {}", internal::power_of_ten(exponent), unit);
}

std::string scatter_panel(const ScatterRow& row, const std::string& metric, const SvgBox& box) {
  const std::vector<double> rpe_m2 = row.samples.column("paper_rpe");
  const std::vector<double> values = row.samples.column(metric);
  const int exponent = exponent_for(values);
  const int rpe_exponent = exponent_for(rpe_m2);
  const double factor = std::pow(10.0, -exponent);
  const double rpe_factor = std::pow(10.0, -rpe_exponent);
  const AxisScale x = axis_of(rpe_m2, rpe_factor, box.left, box.left + box.width);
  const AxisScale y = axis_of(values, factor, box.top + box.height, box.top);
  std::vector<SvgPoint> places;
  std::vector<double> defined;
  std::vector<double> rpe_of_defined;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    places.push_back({x.place(rpe_m2[i] * rpe_factor), y.place(values[i] * factor)});
    defined.push_back(values[i]);
    rpe_of_defined.push_back(rpe_m2[i]);
  }
  const std::optional<double> pearson = correlation(Coefficient::kPearson, defined, rpe_of_defined);
  const bool is_entropy = metric.find("mme") != std::string::npos;
  std::string body = internal::svg_text(
      {box.left - 36, box.top - 8}, "tick", "start",
      fmt::format("{} [{}]{}", label_of(metric).front(), unit_label(is_entropy ? "nats" : "m²", exponent),
                  pearson ? fmt::format(", Pearson {:.3f}", *pearson) : ", undefined"));
  body += internal::y_axis(y, internal::ticks(y.low, y.high, 4), box);
  body += internal::x_axis(x, internal::ticks(x.low, x.high, 4), box, false);
  body += internal::svg_text({box.left + box.width, box.top + box.height + 30}, "axis-name", "end",
                             fmt::format("RPE of the paper [{}]", unit_label("m²", rpe_exponent)));
  return body + internal::svg_dots(places, "cloud", kColors[0]);
}

}  // namespace

Figure correlations_figure(Units units, Correlations correlations) {
  constexpr double kPanelHeight = 200;
  if (units.size() != correlations.size() || units.empty()) {
    throw InvalidArgument(fmt::format("{} units and {} correlations: there must be equally many, and one at least",
                                      units.size(), correlations.size()));
  }
  Drawing drawing{.width = kWidth, .height = 26, .title = "Correlation of the metrics with the RPE", .body = ""};
  drawing.body += legend(units);
  std::vector<ExperimentUnit> scenes;
  for (const ExperimentUnit& unit : units) {
    const bool is_known = std::any_of(scenes.begin(), scenes.end(),
                                      [&](const ExperimentUnit& scene) { return is_same_scene(scene, unit); });
    if (!is_known) scenes.push_back(unit);
  }
  const double column = kWidth / static_cast<double>(kCoefficients.size());
  for (const ExperimentUnit& scene : scenes) {
    for (std::size_t c = 0; c < kCoefficients.size(); ++c) {
      const SvgBox box{.left = column * static_cast<double>(c) + 44,
                       .top = drawing.height + 26,
                       .width = column - 54,
                       .height = kPanelHeight - 80};
      drawing.body += body_of(panel_of(units, correlations, scene, c), box);
    }
    drawing.height += kPanelHeight;
  }
  return {"correlations.svg", internal::standalone_svg(drawing)};
}

Figure scatter_figure(std::span<const ScatterRow> rows) {
  constexpr double kRowHeight = 190;
  if (rows.empty()) throw InvalidArgument("no study: there is nothing to draw");
  Drawing drawing{.width = kWidth, .height = 0, .title = "Metrics over the RPE, a dot a trajectory", .body = ""};
  const double column = kWidth / static_cast<double>(kScatterMetrics.size());
  for (const ScatterRow& row : rows) {
    drawing.body += internal::svg_text({0, drawing.height + 14}, "name", "start", row.title);
    for (std::size_t m = 0; m < kScatterMetrics.size(); ++m) {
      const SvgBox box{.left = column * static_cast<double>(m) + 44,
                       .top = drawing.height + 42,
                       .width = column - 56,
                       .height = kRowHeight - 84};
      drawing.body += scatter_panel(row, kScatterMetrics.at(m), box);
    }
    drawing.height += kRowHeight;
  }
  return {"scatter.svg", internal::standalone_svg(drawing)};
}

}  // namespace trysquare
