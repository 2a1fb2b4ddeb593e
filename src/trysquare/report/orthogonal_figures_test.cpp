// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/orthogonal_figures.h"

#include "trysquare/core/error.h"
#include "trysquare/report/orthogonal_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace trysquare {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string example(const std::vector<OrthogonalWindow>& windows) {
  return to_json(OrthogonalSubsetResult{.reason = "none"}, {}, {.version = "1", .scans = "s", .radius_m = 1}, windows);
}

const std::vector<OrthogonalWindow> kTwo = {
    {.first = 0,
     .last = 4,
     .directions = {{{0, 0, 1}, 120, {}}, {{0, 1, 0}, 30, {}}, {{1, 0, 0}, 12, {}}},
     .num_points = 500,
     .num_planar = 200},
    {.first = 5,
     .last = 9,
     .directions = {{{0, 0, -1}, 90, 0.25}},
     .reason = "one",
     .num_points = 400,
     .num_planar = 150}};

TEST(OrthogonalWindowsCsv, HasARowForEveryWindowAndEmptyCellsForWhatIsMissing) {
  EXPECT_EQ(orthogonal_windows_csv(example(kTwo)),
            "first,last,num_points,num_planar,points_1,normal_x_1,normal_y_1,normal_z_1,moved_deg_1,points_2,"
            "normal_x_2,normal_y_2,normal_z_2,moved_deg_2,points_3,normal_x_3,normal_y_3,normal_z_3,moved_deg_3\n"
            "0,4,500,200,120,0.0,0.0,1.0,,30,0.0,1.0,0.0,,12,1.0,0.0,0.0,\n"
            "5,9,400,150,90,0.0,0.0,-1.0,14.32394487827058,,,,,,,,,,\n");
}

TEST(OrthogonalWindowsFigure, ShowsWhatThereIs) {
  const Figure figure = orthogonal_windows_figure(example(kTwo));
  EXPECT_EQ(figure.file_name, "windows.svg");
  EXPECT_THAT(figure.svg, HasSubstr("Direction 3"));
  EXPECT_THAT(figure.svg, HasSubstr("Largest move"));
  EXPECT_THAT(orthogonal_windows_figure(example({kTwo[1]})).svg, Not(HasSubstr("Direction 3")));
}

TEST(OrthogonalWindowsFigure, RefusesWhatHasNothingToShow) {
  EXPECT_THROW(orthogonal_windows_figure(example({})), InvalidArgument);
  EXPECT_THROW(orthogonal_windows_figure("{}"), InvalidArgument);
  EXPECT_THROW(orthogonal_windows_csv(R"({"schema": "trysquare.orthogonal/1"})"), InvalidArgument);
}

/// Three faces of a cube, a point each 0.1.
OrthogonalSubset cube() {
  OrthogonalSubset subset;
  for (Eigen::Index axis = 2; axis >= 0; --axis) {
    subset.directions.push_back({.normal_in_map = Eigen::Matrix3d::Identity().col(axis), .points_in_map = {}});
    for (int i = 0; i < 10; ++i) {
      for (int j = 0; j < 10; ++j) {
        Eigen::Vector3d point = Eigen::Vector3d::Zero();
        point[(axis + 1) % 3] = 0.1 * i;
        point[(axis + 2) % 3] = 0.1 * j;
        subset.directions.back().points_in_map.push_back(point);
      }
    }
  }
  return subset;
}

std::size_t num_dots(const std::string& svg, const std::string& color) {
  const std::size_t end = svg.find("\" class=\"cloud\" stroke=\"" + color);
  const std::size_t begin = svg.rfind("d=\"", end);
  std::size_t count = 0;
  for (std::size_t at = svg.find("h0", begin); at < end; at = svg.find("h0", at + 1)) ++count;
  return count;
}

// Nearly all of the hundred points of a face are on the sheet, and no two at the same place: no face is seen edge on.
TEST(OrthogonalPicture, ShowsEveryFaceInItsColor) {
  const OrthogonalSubset subset = cube();
  std::vector<Eigen::Vector3d> points;
  for (const auto& direction : subset.directions) {
    points.insert(points.end(), direction.points_in_map.begin(), direction.points_in_map.end());
  }
  const std::string svg = orthogonal_picture(points, subset).svg;
  for (const char* color : {"#c62f2f", "#2e8b3d", "#2b5fc7"}) EXPECT_GT(num_dots(svg, color), 85u) << color;
  EXPECT_GT(num_dots(svg, "#cdd2d8"), 200u);
  EXPECT_THAT(svg, HasSubstr("red: direction 1, 100 points"));
}

TEST(OrthogonalPicture, DrawsPointsWithoutDirections) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 2, 3}, {4, 1, 0}};
  EXPECT_EQ(num_dots(orthogonal_picture(points, {}).svg, "#cdd2d8"), 3u);
  EXPECT_THROW(orthogonal_picture({}, {}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
