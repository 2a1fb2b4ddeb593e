// SPDX-License-Identifier: Apache-2.0
// APE and RPE against the numbers of evo 1.36 on three public sequences: KITTI 00 (poses without stamps), TUM fr2_desk
// and EuRoC V102 (stamps to associate). 156 records of seven statistics each.
#include "trysquare/io/trajectory_file.h"
#include "trysquare/trajectory/ape.h"
#include "trysquare/trajectory/association.h"
#include "trysquare/trajectory/rpe.h"

#include "oracle_data.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <ostream>
#include <string>

namespace trysquare {
namespace {

using nlohmann::json;

struct Sequence {
  std::string name;
  std::string reference_file;
  std::string estimate_file;
  std::size_t num_records;
};

void PrintTo(const Sequence& sequence, std::ostream* out) { *out << sequence.name; }

const Sequence kSequences[] = {
    {"KITTI_00_ORB", "KITTI_00_gt.txt", "KITTI_00_ORB.txt", 52},
    {"fr2_desk_ORB", "fr2_desk_groundtruth.txt", "fr2_desk_ORB.txt", 52},
    {"V102", "V102_groundtruth.csv", "V102.txt", 52},
};

AssociatedTrajectories read(const Sequence& sequence) {
  const auto folder = oracle::data_folder() / "trajectories";
  return associate(read_trajectory((folder / sequence.reference_file).string()).trajectory,
                   read_trajectory((folder / sequence.estimate_file).string()).trajectory);
}

PoseRelation relation_of(const json& record) {
  static const std::map<std::string, PoseRelation> kRelations{{"full_transformation", PoseRelation::kFull},
                                                              {"translation_part", PoseRelation::kTranslationPart},
                                                              {"rotation_part", PoseRelation::kRotationPart},
                                                              {"rotation_angle_deg", PoseRelation::kRotationAngleDeg},
                                                              {"point_distance", PoseRelation::kPointDistance}};
  return kRelations.at(record.at("relation"));
}

TrajectoryErrors errors_of(const json& record, const AssociatedTrajectories& pairs) {
  const PoseRelation relation = relation_of(record);
  const Alignment alignment = alignment_named(record.at("align").get<std::string>()).value();
  if (record.at("metric") == "APE") {
    return ape(pairs.reference, pairs.estimate, {.relation = relation, .alignment = alignment});
  }
  const PosePairSettings settings{.delta = record.at("delta"),
                                  .unit = record.at("unit") == "frames" ? DeltaUnit::kFrames : DeltaUnit::kMetres,
                                  .relative_tolerance = record.at("rel_delta_tol"),
                                  .all_pairs = record.at("all_pairs")};
  return rpe(pairs.reference, pairs.estimate, {.relation = relation, .pairs = settings, .alignment = alignment});
}

/// 1e-9 relative; near zero, where evo's own numbers are round-off, 1e-12 absolute.
void expect_equal(double actual, double expected, const char* name) {
  EXPECT_NEAR(actual, expected, std::max(1e-9 * std::abs(expected), 1e-12)) << name;
}

class TrajectoryOracle : public testing::TestWithParam<Sequence> {};

TEST_P(TrajectoryOracle, EveryRecordOfEvoIsReproduced) {
  TRYSQUARE_REQUIRE_ORACLE("trajectory_oracle.json");
  std::ifstream file(oracle::oracle_folder() / "trajectory_oracle.json");
  const json records = json::parse(file).at("records");
  const AssociatedTrajectories pairs = read(GetParam());
  std::size_t num_records = 0;
  for (const json& record : records) {
    if (record.at("case") != GetParam().name) continue;
    ++num_records;
    json labels = record;
    labels.erase("stats");
    SCOPED_TRACE(labels.dump());
    const TrajectoryErrors errors = errors_of(record, pairs);
    EXPECT_EQ(errors.errors.size(), record.at("pairs"));
    const json& expected = record.at("stats");
    expect_equal(errors.statistics.rmse, expected.at("rmse"), "rmse");
    expect_equal(errors.statistics.mean, expected.at("mean"), "mean");
    expect_equal(errors.statistics.median, expected.at("median"), "median");
    expect_equal(errors.statistics.std, expected.at("std"), "std");
    expect_equal(errors.statistics.min, expected.at("min"), "min");
    expect_equal(errors.statistics.max, expected.at("max"), "max");
    expect_equal(errors.statistics.sse, expected.at("sse"), "sse");
  }
  EXPECT_EQ(num_records, GetParam().num_records);
}

INSTANTIATE_TEST_SUITE_P(Evo, TrajectoryOracle, testing::ValuesIn(kSequences), [](const auto& sequence) {
  std::string name = sequence.param.name;  // GoogleTest allows no underscores in names
  name.erase(std::remove(name.begin(), name.end(), '_'), name.end());
  return name;
});

}  // namespace
}  // namespace trysquare
