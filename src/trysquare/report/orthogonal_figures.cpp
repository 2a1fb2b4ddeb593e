// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/orthogonal_figures.h"

#include "trysquare/core/error.h"
#include "trysquare/report/internal/charts.h"
#include "trysquare/report/internal/charts_series.h"
#include "trysquare/report/internal/json.h"
#include "trysquare/report/internal/svg.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace trysquare {
namespace {

using internal::Json;
using internal::SvgPoint;

constexpr const char* kSchema = "trysquare.orthogonal/1";
constexpr std::array<const char*, 3> kColors = {"#c62f2f", "#2e8b3d", "#2b5fc7"};
constexpr std::array<const char*, 3> kColorNames = {"red", "green", "blue"};

template <class Use>
auto with_json(std::string_view text, const Use& use) {
  try {
    return use(internal::parse(text, kSchema));
  } catch (const Json::exception& error) {
    throw InvalidArgument(fmt::format("JSON: not as {} says: {}", kSchema, error.what()));
  }
}

std::string cell(const Json& value) { return value.is_null() ? "" : value.dump(); }

/// Piece by piece: g++ 12 warns of the sum of a literal and a string.
void append_cell(std::string& row, const Json& value) { row.append(",").append(cell(value)); }

std::string csv_of(const Json& document) {
  std::string text = "first,last,num_points,num_planar";
  for (int i = 1; i <= 3; ++i) {
    text += fmt::format(",points_{0},normal_x_{0},normal_y_{0},normal_z_{0},moved_deg_{0}", i);
  }
  text += "\n";
  for (const Json& window : document.at("windows")) {
    text += cell(window.at("first"));
    for (const char* key : {"last", "num_points", "num_planar"}) append_cell(text, window.at(key));
    const Json& directions = window.at("directions");
    for (std::size_t i = 0; i < 3; ++i) {
      if (i >= directions.size()) {
        text += ",,,,,";
        continue;
      }
      append_cell(text, directions[i].at("num_points"));
      for (const Json& coordinate : directions[i].at("normal")) append_cell(text, coordinate);
      append_cell(text, directions[i].at("moved_deg"));
    }
    text += "\n";
  }
  return text;
}

void add(internal::WindowSeries& series, std::optional<double> value, const char* reason) {
  series.values.push_back(value);
  series.reasons.emplace_back(value ? "" : reason);
  series.is_limited.push_back(false);
}

internal::WindowTable table_of(const Json& windows) {
  internal::WindowTable table;
  internal::WindowSeries moved{
      .key = "moved", .name = "Largest move of a direction", .unit = "deg", .starts_at_zero = true};
  for (const Json& window : windows) {
    table.windows.push_back({window.at("first").get<std::size_t>(), window.at("last").get<std::size_t>()});
    std::optional<double> largest_deg;
    for (const Json& direction : window.at("directions")) {
      const Json& moved_deg = direction.at("moved_deg");
      if (!moved_deg.is_null()) largest_deg = std::max(largest_deg.value_or(0), moved_deg.get<double>());
    }
    add(moved, largest_deg, "no direction before");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    internal::WindowSeries points{.key = fmt::format("points_{}", i + 1),
                                  .name = fmt::format("Direction {}", i + 1),
                                  .unit = "points",
                                  .starts_at_zero = true};
    for (const Json& window : windows) {
      const Json& directions = window.at("directions");
      add(points, i < directions.size() ? std::optional(directions[i].at("num_points").get<double>()) : std::nullopt,
          "not found");
    }
    table.series.push_back(std::move(points));
  }
  table.series.push_back(std::move(moved));
  return table;
}

/// Rows: to the right, upwards, towards the eye. Looks down on the faces of all three directions.
Eigen::Matrix3d oblique_view(const OrthogonalSubset& subset) {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d side = Eigen::Vector3d::UnitX();
  if (!subset.directions.empty()) up = subset.directions[0].normal_in_map;
  if (up.isZero()) up = Eigen::Vector3d::UnitZ();  // a subset without normals
  if (subset.directions.size() > 1 && !subset.directions[1].normal_in_map.isZero()) {
    side = subset.directions[1].normal_in_map;
  } else if (std::abs(up.x()) > 0.7) {
    side = Eigen::Vector3d::UnitY();
  }
  side = (side - side.dot(up) * up).normalized();
  const Eigen::Vector3d towards = (up.cross(side) + side + 0.8 * up).normalized();
  const Eigen::Vector3d right = up.cross(towards).normalized();
  Eigen::Matrix3d view;
  view << right.transpose(), towards.cross(right).transpose(), towards.transpose();
  return view;
}

/// The middle 98 % of some numbers.
std::pair<double, double> middle_of(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  const std::size_t margin = numbers.size() / 100;
  return {numbers[margin], numbers[numbers.size() - 1 - margin]};
}

/// Places on the sheet for points in the map.
struct Sheet {
  Eigen::Matrix3d view = Eigen::Matrix3d::Identity();
  double left_m = 0;
  double top_m = 0;
  double units_per_m = 1;
  double width = internal::kFigureWidth;
  double height = 0;
  double top = 0;

  std::vector<SvgPoint> places_of(PointsView points, std::size_t every) const {
    std::vector<SvgPoint> places;
    for (std::size_t i = 0; i < points.size(); i += every) {
      const Eigen::Vector3d seen = view * points[i];
      const SvgPoint place{(seen.x() - left_m) * units_per_m, top + (top_m - seen.y()) * units_per_m};
      if (place.x >= 0 && place.x <= width && place.y >= top && place.y <= top + height) places.push_back(place);
    }
    return places;
  }
};

Sheet sheet_for(PointsView points, const OrthogonalSubset& subset) {
  Sheet sheet{.view = oblique_view(subset)};
  std::vector<double> right;
  std::vector<double> up;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d seen = sheet.view * point;
    right.push_back(seen.x());
    up.push_back(seen.y());
  }
  const auto [left_m, right_m] = middle_of(std::move(right));
  const auto [bottom_m, top_m] = middle_of(std::move(up));
  const double most_height = 2 * sheet.width;
  const double width_m = std::max(right_m - left_m, 1e-9);
  const double height_m = top_m - bottom_m;
  sheet.units_per_m = std::min(sheet.width / width_m, height_m > 0 ? most_height / height_m : sheet.width / width_m);
  sheet.left_m = (left_m + right_m) / 2 - sheet.width / sheet.units_per_m / 2;
  sheet.height = std::max(height_m * sheet.units_per_m, 20.0);
  sheet.top_m = (top_m + bottom_m) / 2 + sheet.height / sheet.units_per_m / 2;
  return sheet;
}

}  // namespace

std::string orthogonal_windows_csv(std::string_view orthogonal_json) { return with_json(orthogonal_json, csv_of); }

Figure orthogonal_windows_figure(std::string_view orthogonal_json) {
  return with_json(orthogonal_json, [](const Json& document) -> Figure {
    const internal::WindowTable table = table_of(document.at("windows"));
    if (!std::any_of(table.series.begin(), table.series.end(), internal::has_value)) {
      throw InvalidArgument("no direction in any window: there is nothing to draw");
    }
    return {"windows.svg", internal::standalone_svg(internal::stacked_window_charts(table))};
  });
}

Figure orthogonal_picture(PointsView points_in_map, const OrthogonalSubset& subset) {
  constexpr std::size_t kMostGreyPoints = 20'000;
  constexpr double kLineHeight = 17;
  if (points_in_map.empty()) throw InvalidArgument("points_in_map is empty: there is nothing to draw");
  Sheet sheet = sheet_for(points_in_map, subset);
  sheet.top = kLineHeight * static_cast<double>(subset.directions.size()) + 12;
  internal::Drawing drawing{.width = sheet.width,
                            .height = sheet.top + sheet.height,
                            .title = "Points of the scans and of the orthogonal surfaces among them",
                            .body = ""};
  const std::size_t every = points_in_map.size() / kMostGreyPoints + 1;
  drawing.body += internal::svg_dots(sheet.places_of(points_in_map, every), "cloud", "#cdd2d8");
  for (std::size_t i = 0; i < subset.directions.size() && i < kColors.size(); ++i) {
    const OrthogonalSubset::Direction& direction = subset.directions[i];
    const double baseline = kLineHeight * static_cast<double>(i) + 12;
    drawing.body += internal::svg_dots(sheet.places_of(direction.points_in_map, 1), "cloud", kColors[i]);
    drawing.body += internal::svg_box({0, baseline - 9, 10, 10}, "color", kColors[i], "");
    drawing.body += internal::svg_text(
        {16, baseline}, "name", "start",
        fmt::format("{}: direction {}, {} points", kColorNames[i], i + 1, direction.points_in_map.size()));
  }
  return {"orthogonal.svg", internal::standalone_svg(drawing)};
}

}  // namespace trysquare
