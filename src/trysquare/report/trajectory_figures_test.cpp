// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/trajectory_figures.h"

#include "trysquare/trajectory/ape.h"
#include "trysquare/trajectory/rpe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace trysquare {
namespace {

using testing::HasSubstr;

Trajectory circle(int num_poses, double radius_m) {
  Trajectory trajectory;
  for (int i = 0; i < num_poses; ++i) {
    const double angle = 6.0 * i / num_poses;
    trajectory.world_from_scan.push_back({.translation = {radius_m * std::cos(angle), radius_m * std::sin(angle), 0}});
    trajectory.stamps_ns.push_back(1'000'000'000LL * i);
  }
  return trajectory;
}

std::vector<Figure> figures_of(const Trajectory& reference, const Trajectory& estimate) {
  const TrajectoryErrors errors = ape(reference, estimate);
  return error_figures(errors, error_series(errors, reference, estimate), reference);
}

TEST(ErrorFigures, ThereAreThreeWithTimeStampsAndTwoWithout) {
  Trajectory estimate = circle(50, 11);
  EXPECT_EQ(figures_of(circle(50, 10), estimate).size(), 3u);
  estimate.stamps_ns.clear();
  const std::vector<Figure> figures = figures_of(circle(50, 10), estimate);
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[0].file_name, "error_map.svg");
  EXPECT_THAT(figures[0].svg, HasSubstr("APE trans_part [m]"));
  EXPECT_THAT(figures[1].svg, HasSubstr("distance [m]"));
}

TEST(ErrorFigures, AreNotAsLongAsTheTrajectory) {
  for (const Figure& figure : figures_of(circle(100'000, 10), circle(100'000, 10.5))) {
    EXPECT_LT(figure.svg.size(), figure.file_name == "error_map.svg" ? 250'000u : 60'000u) << figure.file_name;
  }
}

TEST(ErrorFigures, KeepPeaksOfLongSeries) {
  Trajectory estimate = circle(100'000, 10);
  estimate.world_from_scan[54'321].translation.z() = 7;
  const std::vector<Figure> figures = figures_of(circle(100'000, 10), estimate);
  // the only point of the line that is not on the axis: at 7 of 7.56, so 150 · (1 − 1/1.08) below the top of 28
  EXPECT_THAT(figures[1].svg, HasSubstr("39.1"));
}

TEST(ErrorFigures, ExistForOnePoseAndForEqualTrajectories) {
  EXPECT_EQ(figures_of(circle(1, 1), circle(1, 1)).size(), 3u);
  for (const Figure& figure : figures_of(circle(9, 1), circle(9, 1))) {
    EXPECT_EQ(figure.svg.find("nan"), std::string::npos) << figure.file_name;
  }
}

}  // namespace
}  // namespace trysquare
