// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/diagnosis_json.h"

#include "trysquare/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <numbers>
#include <string>

namespace trysquare {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const DiagnosisFacts kFacts{.version = "1.2.3", .scans = "scans", .poses = "poses.txt", .poses_format = "kitti"};

TEST(DiagnosisJson, HoldsAnglesInDegreesAndLengthsInMetres) {
  Diagnosis diagnosis{.num_scans = 9};
  diagnosis.suspects.poses = {{.scan = 4,
                               .translation_m = 0.1,
                               .rotation_rad = std::numbers::pi / 180,
                               .translation_interval_m = {0.05, 0.15},
                               .rotation_interval_rad = {0, std::numbers::pi / 90},
                               .score = 12}};
  const json document = json::parse(to_json(diagnosis, {}, kFacts));
  const json& suspect = document.at("suspects").at(0);
  EXPECT_EQ(suspect.at("scan"), 4);
  EXPECT_EQ(suspect.at("translation_interval_m"), json({0.05, 0.15}));
  EXPECT_NEAR(suspect.at("rotation_error_deg").get<double>(), 1, 1e-12);
  EXPECT_NEAR(suspect.at("rotation_interval_deg").at(1).get<double>(), 2, 1e-12);
}

TEST(DiagnosisJson, TellsAnEmptyListFromOneThatWasNotLookedFor) {
  const json clean = json::parse(to_json({.num_scans = 9}, {}, kFacts));
  EXPECT_EQ(clean.at("suspects"), json::array());
  EXPECT_EQ(clean.at("ghost_walls"), json::array());
  const json wrong_frame =
      json::parse(to_json({.num_scans = 9, .blame_reason = "a frame", .suspects_reason = "a frame"}, {}, kFacts));
  EXPECT_TRUE(wrong_frame.at("suspects").is_null());
  EXPECT_TRUE(wrong_frame.at("ghost_walls").is_null());
  EXPECT_EQ(wrong_frame.at("ghost_walls_reason"), "a frame");
  const json two_scans = json::parse(to_json({.num_scans = 2, .reason = "too few"}, {}, kFacts));
  EXPECT_EQ(two_scans.at("judged"), false);
  EXPECT_EQ(two_scans.at("suspects_reason"), "too few");
}

TEST(FindingsCsv, QuotesTextsAndLeavesFiguresThatThereAreNotEmpty) {
  Diagnosis diagnosis{.num_scans = 9};
  diagnosis.findings = {{"a", Severity::kError, "say \"x\", y", "mend it", Evidence{0.5, 0.25, "m"}},
                        {"b", Severity::kNote, "z", "w", std::nullopt}};
  EXPECT_EQ(findings_csv(to_json(diagnosis, {}, kFacts)),
            "id,severity,found,limit,unit,message,remedy\n"
            "a,error,0.5,0.25,m,\"say \"\"x\"\", y\",\"mend it\"\n"
            "b,note,,,,\"z\",\"w\"\n");
}

TEST(FindingsCsv, RefusesAnotherDocument) {
  EXPECT_THROW(findings_csv("{\"schema\": \"trysquare.evaluation/1\"}"), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
