// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/charts.h"

#include "trysquare/core/error.h"
#include "trysquare/report/internal/charts_axis.h"
#include "trysquare/report/internal/charts_test_example.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace trysquare::internal {
namespace {

/// The points of the first path of the class.
std::vector<SvgPoint> path_of(const std::string& body, const std::string& css_class) {
  const std::size_t end = body.find("\" class=\"" + css_class + "\"");
  const std::size_t begin = body.rfind("d=\"", end) + 3;
  std::string data = body.substr(begin, end - begin);
  for (char& c : data) c = c == 'M' || c == 'L' ? ' ' : c;
  std::vector<SvgPoint> points;
  for (std::size_t at = 0; at < data.size();) {
    std::size_t length = 0;
    const double x = std::stod(data.substr(at), &length);
    at += length;
    const double y = std::stod(data.substr(at), &length);
    at += length;
    points.push_back({x, y});
  }
  return points;
}

Json evaluation_along(const std::vector<std::array<double, 3>>& positions) {
  Json evaluation = example_evaluation();
  evaluation["trajectory"]["positions_in_map_m"] = positions;
  return evaluation;
}

const WindowSeries kOneValue = {
    .key = "mpv", .name = "MPV", .unit = "m2", .values = {0.5}, .reasons = {""}, .is_limited = {false}};

TEST(Ticks, AreRoundNumbersWithinTheRange) {
  const Ticks marks = ticks(-0.3, 9.7, 5);
  EXPECT_EQ(marks.step, 2);
  EXPECT_EQ(marks.values, (std::vector<double>{0, 2, 4, 6, 8}));
  EXPECT_EQ(ticks(0, 1, 5).values.size(), 6U);
}

TEST(Ticks, OfScansAreWholeNumbers) { EXPECT_EQ(whole_ticks(-0.5, 3.5, 10).step, 1); }

TEST(Ticks, EndEvenWhereTheStepIsLostInRounding) {
  EXPECT_LE(ticks(1e17, 1e17 + 16, 5).values.size(), 50U);
  EXPECT_TRUE(ticks(-1e308, 1e308, 5).values.empty());
}

TEST(Colors, GetLighterFromLowToHigh) {
  double previous = -1;
  for (int i = 0; i <= 100; ++i) {
    const std::string color = color_of(i / 100.0);
    std::array<double, 3> linear = {};
    for (std::size_t k = 0; k < 3; ++k) {
      linear[k] = std::pow(std::stoi(color.substr(1 + 2 * k, 2), nullptr, 16) / 255.0, 2.2);
    }
    const double luminance = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
    EXPECT_GT(luminance, previous) << i;
    previous = luminance;
  }
}

TEST(WindowChart, BreaksTheLineWhereAWindowIsUndefined) {
  const WindowTable table = window_table(example_evaluation());
  const WindowSeries& mom = table.series.front();
  ASSERT_EQ(mom.key, "mom");
  const std::string body = window_chart(table.windows, mom).body;
  EXPECT_EQ(occurrences(body, "class=\"series\""), 2U);
  EXPECT_EQ(occurrences(body, "class=\"gap\""), 1U);
  EXPECT_EQ(occurrences(body, "<circle"), 3U);
  EXPECT_NE(body.find("undefined: no direction has points"), std::string::npos);
}

TEST(WindowChart, ShowsValuesThatDoNotFollowTheErrorAsHollowDots) {
  const WindowTable table = window_table(example_evaluation());
  EXPECT_EQ(occurrences(window_chart(table.windows, table.series[0]).body, "class=\"hollow\""), 1U);
  ASSERT_EQ(table.series[1].key, "mpv");
  EXPECT_EQ(occurrences(window_chart(table.windows, table.series[1]).body, "class=\"hollow\""), 0U);
}

TEST(WindowChart, OfEqualValuesHasNumbersAsPlaces) {
  const WindowTable table = window_table(example_evaluation());
  for (const double value : {0.0, -3.0, 1e-300, 1e300}) {
    WindowSeries series = table.series[1];
    series.values.assign(4, value);
    EXPECT_EQ(window_chart(table.windows, series).body.find("nan"), std::string::npos) << value;
  }
}

TEST(WindowChart, IsOfNothingThatWasNotAskedFor) {
  for (const WindowSeries& series : window_table(example_evaluation()).series) EXPECT_NE(series.key, "omme");
}

TEST(HeatMap, HasOneSegmentPerWindow) {
  const Json evaluation = example_evaluation();
  const WindowTable table = window_table(evaluation);
  const std::string body = heat_map(evaluation, table.windows, table.series[0])->body;
  EXPECT_EQ(occurrences(body, "class=\"segment\""), 3U);
  EXPECT_EQ(occurrences(body, "</path>") - occurrences(body, "class=\"casing\""), 3U + 1U + 1U);  // + undefined + path
  EXPECT_EQ(occurrences(body, "class=\"segment\" stroke=\"" + color_of(0) + "\""), 1U);
  EXPECT_EQ(occurrences(body, "class=\"segment\" stroke=\"" + color_of(1) + "\""), 1U);
}

TEST(HeatMap, SegmentsOfTouchingWindowsMeet) {
  const Json evaluation = example_evaluation();
  const WindowTable table = window_table(evaluation);
  const std::string body = heat_map(evaluation, table.windows, table.series[1])->body;
  const SvgPoint end_of_first = path_of(body, "segment").back();
  const std::size_t second = body.find("class=\"segment\"") + 1;
  const SvgPoint begin_of_second = path_of(body.substr(second), "segment").front();
  EXPECT_EQ(end_of_first.x, begin_of_second.x);
  EXPECT_EQ(end_of_first.y, begin_of_second.y);
}

TEST(HeatMap, HasTheSameScaleOnBothAxes) {
  for (const double height : {0.1, 3.0, 10.0}) {
    const Json evaluation = evaluation_along({{0, 0, 0}, {10, 0, 0}, {10, height, 0}});
    const auto points = path_of(heat_map(evaluation, {{0, 2}}, kOneValue)->body, "path");
    const double units_per_metre = (points[1].x - points[0].x) / 10;
    EXPECT_NEAR((points[1].y - points[2].y) / height, units_per_metre, 0.011 / height) << height;
  }
}

TEST(HeatMap, ShowsThePathAsLargeAsTheFigureAllows) {
  for (const double height : {0.1, 5.0, 10.0}) {
    const Json evaluation = evaluation_along({{0, 0, 0}, {10, 0, 0}, {10, height, 0}});
    const Drawing map = *heat_map(evaluation, {{0, 2}}, kOneValue);
    const auto points = path_of(map.body, "path");
    EXPECT_GT(points[0].x, 0.1 * map.width);  // right of the numbers of the axis
    EXPECT_LT(points[1].x, map.width - 10);
    EXPECT_GT(points[1].x - points[0].x, 0.7 * map.width);
    EXPECT_GT(points[2].y, 50);  // below the legend
    EXPECT_LT(points[0].y, map.height - 40);
  }
}

TEST(HeatMap, ALeftTurnStaysALeftTurnInEveryPlaneOfTheMap) {
  for (std::size_t forward = 0; forward < 3; ++forward) {
    for (const double length : {5.0, 20.0}) {
      std::array<double, 3> corner = {};
      corner[forward] = 10;
      std::array<double, 3> end = corner;
      end[(forward + 1) % 3] = length;  // about the third axis, a turn to the left
      const Json evaluation = evaluation_along({{0, 0, 0}, corner, end});
      const auto points = path_of(heat_map(evaluation, {{0, 2}}, kOneValue)->body, "path");
      const double turn = (points[1].x - points[0].x) * (points[2].y - points[1].y) -
                          (points[1].y - points[0].y) * (points[2].x - points[1].x);
      EXPECT_LT(turn, 0) << forward << " " << length;  // y points down
    }
  }
}

TEST(HeatMap, OfASensorThatNeverMovesHasNumbersAsPlaces) {
  const Json evaluation = evaluation_along({{1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(heat_map(evaluation, {{0, 1}}, kOneValue)->body.find("nan"), std::string::npos);
}

TEST(HeatMap, OfAWindowBeyondTheTrajectoryIsRefused) {
  const Json evaluation = evaluation_along({{0, 0, 0}, {1, 0, 0}});
  EXPECT_THROW(heat_map(evaluation, {{0, 2}}, kOneValue), InvalidArgument);
}

TEST(HeatMap, NeedsATrajectory) {
  Json evaluation = example_evaluation();
  evaluation["trajectory"] = nullptr;
  EXPECT_FALSE(heat_map(evaluation, {{0, 2}}, kOneValue));
}

}  // namespace
}  // namespace trysquare::internal
