// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/evo_result.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

namespace trysquare {
namespace {

using nlohmann::json;

Trajectory run(double scale) {
  Trajectory trajectory;
  for (const double x : {0.0, 1.0, 3.0, 6.0}) {
    trajectory.world_from_scan.push_back({.translation = {scale * x, x * x, 0}});
  }
  trajectory.stamps_ns = {10'000'000'000, 10'500'000'000, 11'000'000'000, 11'500'000'000};
  return trajectory;
}

TEST(EvoResult, HasTheTitlesAndLabelsOfEvo) {
  const ApeSettings settings{.alignment = Alignment::kSim3};
  const TrajectoryErrors errors = ape(run(1), run(2), settings);
  const EvoResult result = evo_result(errors, settings, error_series(errors, run(1), run(2)), "gt.txt", "a.txt");
  const json info = json::parse(result.info_json);
  EXPECT_EQ(info["title"], "APE w.r.t. translation part (m)\n(with Sim(3) Umeyama alignment)");
  EXPECT_EQ(info["label"], "APE (m)");
  EXPECT_EQ(info["ref_name"], "gt.txt");
  EXPECT_EQ(json::parse(result.stats_json)["rmse"], errors.statistics.rmse);
  ASSERT_EQ(result.arrays.size(), 6u);
  EXPECT_EQ(result.arrays[0].name, "error_array");
  EXPECT_EQ(result.arrays[5].values.size(), 16u);
}

TEST(EvoResult, OfRpeSaysItsPairs) {
  const RpeSettings settings{.pairs = {.delta = 2, .unit = DeltaUnit::kMetres}};
  const TrajectoryErrors errors = rpe(run(1), run(2), settings);
  const EvoResult result = evo_result(errors, settings, error_series(errors, run(1), run(2)), "a", "b");
  EXPECT_EQ(json::parse(result.info_json)["title"],
            "RPE w.r.t. translation part (m)\nfor delta = 2.0 (m) using consecutive pairs\n(not aligned)");
}

TEST(ErrorsCsv, HasALinePerError) {
  const TrajectoryErrors errors = rpe(run(1), run(2), {.pairs = {.delta = 3}});
  EXPECT_EQ(errors_csv(errors, error_series(errors, run(1), run(2))).substr(0, 56),
            "first,second,stamp_s,reference_distance_m,error_m\n0,3,11");
  const TrajectoryErrors absolute = ape(run(1), run(1));
  const std::string text = errors_csv(absolute, error_series(absolute, run(1), run(1)));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
}

}  // namespace
}  // namespace trysquare
