// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/trajectory_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace trysquare {
namespace {

using nlohmann::json;

TrajectoryErrors example() {
  TrajectoryErrors errors;
  errors.errors = {1.0, 3.0};
  errors.statistics = error_statistics(errors.errors);
  errors.relation = PoseRelation::kRotationAngleDeg;
  return errors;
}

TEST(TrajectoryJson, HasEvosStatisticsAndTheirUnit) {
  const json document =
      json::parse(to_json(example(), ApeSettings{.alignment = Alignment::kSe3}, {.version = "1.2.3"}));
  EXPECT_EQ(document["schema"], "trysquare.trajectory/1");
  EXPECT_EQ(document["metric"], "ape");
  EXPECT_EQ(document["num_pairs"], 2);
  EXPECT_EQ(document["unit"], "deg");
  EXPECT_EQ(document["statistics"]["mean"], 2.0);
  EXPECT_EQ(document["statistics"]["sse"], 10.0);
  EXPECT_EQ(document["settings"]["alignment"], "se3");
  EXPECT_FALSE(document["settings"].contains("delta"));
}

TEST(TrajectoryJson, OfRpeSaysWhichPairsWereTaken) {
  RpeSettings settings;
  settings.pairs = {.delta = 10, .unit = DeltaUnit::kMetres, .all_pairs = true};
  const json document = json::parse(to_json(example(), settings, {}));
  EXPECT_EQ(document["metric"], "rpe");
  EXPECT_EQ(document["settings"]["delta"], 10.0);
  EXPECT_EQ(document["settings"]["all_pairs"], true);
}

}  // namespace
}  // namespace trysquare
