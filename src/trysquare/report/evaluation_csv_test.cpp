// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/evaluation_csv.h"

#include "trysquare/core/error.h"
#include "trysquare/report/evaluation_json.h"

#include <gtest/gtest.h>

#include <string>

namespace trysquare {
namespace {

std::string example() {
  Evaluation evaluation;
  evaluation.mom.emplace();
  evaluation.positions_in_map = {{0, 0.5, 0}, {1e-3, 4, -2}};
  WindowEvaluation window{.first = 0, .last = 9, .rpe_translation_rms_m = 0.125, .rpe_estimate_m = 0.5};
  window.mom.value = 0.25;
  window.overlap = {.num_neighborhoods = 3, .scans_per_neighborhood_mean = 7.5, .multi_scan_share = 1.0};
  evaluation.windows = {window, {.first = 10, .last = 19}};
  return to_json(evaluation, {});
}

TEST(WindowsCsv, HasOneRowPerWindowWithUnitsInTheHeader) {
  EXPECT_EQ(windows_csv(example()),
            "first,last,mom_m2,omme_nats,mpv_m2,mme_nats,multi_scan_share,scans_per_neighborhood,rpe_estimate_m,rpe_m\n"
            "0,9,0.25,,,,1.0,7.5,0.5,0.125\n"
            "10,19,,,,,,,,\n");
}

constexpr const char* kPosesHeader = "index,x_m,y_m,z_m,error_x_m,error_y_m,error_z_m,sigma_m,score,suspect\n";

TEST(PosesCsv, HasOneRowPerPose) {
  EXPECT_EQ(poses_csv(example()), kPosesHeader + std::string("0,0.0,0.5,0.0,,,,,,\n1,0.001,4.0,-2.0,,,,,,\n"));
}

TEST(PosesCsv, HasTheErrorOfEveryPoseWhenItIsKnown) {
  Evaluation evaluation;
  evaluation.positions_in_map = {{0, 0.5, 0}};
  evaluation.rpe_estimate.emplace();
  PoseDeviation deviation{.error = {.translation_m = {0.5, 0, -0.25}}, .score = 7, .suspect = true};
  evaluation.rpe_estimate->poses = {{.deviation = deviation, .sigma_m = 0.125}};
  EXPECT_EQ(poses_csv(to_json(evaluation, {})),
            kPosesHeader + std::string("0,0.0,0.5,0.0,0.5,0.0,-0.25,0.125,7.0,true\n"));
}

TEST(EvaluationCsv, RefusesWhatIsNoEvaluation) {
  EXPECT_THROW(windows_csv("{}"), InvalidArgument);
  EXPECT_THROW(poses_csv("not JSON"), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
