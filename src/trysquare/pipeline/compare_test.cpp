// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/compare.h"

#include "trysquare/core/error.h"
#include "trysquare/simulation/drive.h"
#include "trysquare/simulation/sensor_model.h"
#include "trysquare/simulation/simulated_scans.h"
#include "trysquare/simulation/simulated_world.h"
#include "trysquare/synthetic/memory_scans.h"
#include "trysquare/synthetic/perturb.h"
#include "trysquare/trajectory/all_pairs_rpe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::size_t kNumScans = 14;

/// A drive along a street, and what is made of its true poses.
struct Drive {
  MemoryScans scans;
  Trajectory truth;

  Candidate perturbed_by(const std::string& name, double translation_m, std::uint64_t seed) const {
    constexpr double kRotation_rad = 0.05 * std::numbers::pi / 180;
    return {.name = name,
            .world_from_scan = perturb(
                truth, {.translation_sigma_m = translation_m, .rotation_sigma_rad = kRotation_rad, .seed = seed})};
  }
};

const Drive& a_drive() {
  static const Drive kDrive = [] {
    const SimulatedWorld world = make_world(WorldStyle::kStreet, 3);
    Trajectory poses = drive(world, {.num_scans = kNumScans, .seed = 3});
    const SimulatedScans simulated(world, poses, sensor_preset("carla32"), 3);
    std::vector<Scan> scans;
    for (std::size_t i = 0; i < kNumScans; ++i) scans.push_back(simulated.load(i));
    return Drive{.scans = MemoryScans(std::move(scans)), .truth = std::move(poses)};
  }();
  return kDrive;
}

ComparisonSettings quick() {
  ComparisonSettings settings;
  settings.evaluation.metrics = {Metric::kMpv, Metric::kRpe};
  settings.evaluation.query_every = 20;
  return settings;
}

const MetricComparison& by(const Comparison& comparison, Metric metric) {
  for (const MetricComparison& each : comparison.by_metric) {
    if (each.metric == metric) return each;
  }
  throw InvalidArgument("not compared");
}

TEST(Compare, NamesTheBetterOne) {
  const Drive& drive = a_drive();
  const std::vector<Candidate> candidates = {drive.perturbed_by("bad", 0.08, 1), drive.perturbed_by("good", 0.01, 2)};
  const Comparison comparison = compare(drive.scans, candidates, quick());
  const MetricComparison& rpe = by(comparison, Metric::kRpe);
  ASSERT_EQ(rpe.pairs.size(), 1U);
  EXPECT_EQ(rpe.pairs[0].num_windows, 7U);  // of two scans
  EXPECT_EQ(rpe.pairs[0].better, 1U);
  EXPECT_LE(*rpe.pairs[0].p_adjusted, 0.05);
  EXPECT_GT(rpe.pairs[0].interval->low, 0);
  EXPECT_THAT(rpe.ranks, ElementsAre(2, 1));
  EXPECT_EQ(comparison.decisive, Metric::kRpe);
  EXPECT_THAT(comparison.best, ElementsAre(1));
}

TEST(Compare, MeasuresEveryCandidateAgainstTheSamePoses) {
  const Drive& drive = a_drive();
  const std::vector<Candidate> candidates = {drive.perturbed_by("bad", 0.08, 1), drive.perturbed_by("good", 0.01, 2)};
  const Comparison comparison = compare(drive.scans, candidates, quick());
  EXPECT_EQ(comparison.adjusted_from, 1U);
  EXPECT_LT(*comparison.adjusted_agreement_m, 0.005);
  for (std::size_t i = 0; i < 2; ++i) {
    const double truth_m = all_pairs_rpe(drive.truth, candidates[i].world_from_scan).translation_m.rmse;
    EXPECT_GE(truth_m, comparison.trajectories[i].interval_m->low) << i;
    EXPECT_LE(truth_m, comparison.trajectories[i].interval_m->high) << i;
  }
}

/// Its own estimate must be refused: twice as far off as any adjustment reaches.
TEST(Compare, MeasuresACandidateThatIsTooFarOffForAnEstimateOfItsOwn) {
  const Drive& drive = a_drive();
  const std::vector<Candidate> candidates = {drive.perturbed_by("lost", 5, 1), drive.perturbed_by("good", 0.02, 2)};
  const Comparison comparison = compare(drive.scans, candidates, quick());
  ASSERT_EQ(comparison.trajectories[0].evaluation.rpe_estimate->status, EstimateStatus::kRefused);
  const double truth_m = all_pairs_rpe(drive.truth, candidates[0].world_from_scan).translation_m.rmse;
  EXPECT_NEAR(*comparison.trajectories[0].rpe_m, truth_m, 0.01);
  EXPECT_THAT(comparison.best, ElementsAre(1));
}

TEST(Compare, LeavesATieBetweenEquals) {
  const Drive& drive = a_drive();
  const std::vector<Candidate> candidates = {drive.perturbed_by("one", 0.03, 1), drive.perturbed_by("other", 0.03, 2)};
  const Comparison comparison = compare(drive.scans, candidates, quick());
  EXPECT_FALSE(by(comparison, Metric::kRpe).pairs[0].better);
  EXPECT_THAT(by(comparison, Metric::kRpe).ranks, ElementsAre(1, 1));
  EXPECT_THAT(comparison.best, ElementsAre(0, 1));
}

TEST(Compare, DecidesByIntervalsWhereWindowsAreTooFew) {
  const Drive& drive = a_drive();
  const std::vector<Candidate> candidates = {drive.perturbed_by("bad", 0.08, 1), drive.perturbed_by("good", 0.01, 2)};
  ComparisonSettings settings = quick();
  settings.evaluation.window = 7;
  const Comparison comparison = compare(drive.scans, candidates, settings);
  const PairedDifference& pair = by(comparison, Metric::kRpe).pairs[0];
  EXPECT_EQ(pair.num_windows, 2U);
  EXPECT_FALSE(pair.interval);
  EXPECT_EQ(pair.better, 1U);
  EXPECT_FALSE(by(comparison, Metric::kMpv).pairs[0].better);
}

TEST(Compare, SaysWhenNothingCanBeCompared) {
  const std::vector<Scan> scans(4, Scan{.points_in_scan = {{5, 0, 0}, {0, 5, 0}}});
  Trajectory apart;
  for (int i = 0; i < 4; ++i) apart.world_from_scan.push_back({.translation = {100.0 * i, 0, 0}});
  const std::vector<Candidate> candidates = {{.name = "a", .world_from_scan = apart, .body_from_sensor = {}},
                                             {.name = "b", .world_from_scan = apart, .body_from_sensor = {}}};
  const Comparison comparison = compare(MemoryScans(scans), candidates, quick());
  EXPECT_FALSE(comparison.verdict.meaningful);
  EXPECT_FALSE(comparison.verdict.reasons.empty());
  EXPECT_FALSE(comparison.decisive);
  EXPECT_TRUE(comparison.best.empty());
}

TEST(Compare, RefusesCandidatesThatDoNotFit) {
  const Drive& drive = a_drive();
  const Candidate one = drive.perturbed_by("one", 0.01, 1);
  const auto message_for = [&](const std::vector<Candidate>& candidates) -> std::string {
    try {
      compare(drive.scans, candidates, quick());
    } catch (const InvalidArgument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message_for({one}), HasSubstr("at least two"));
  EXPECT_THAT(message_for({one, one}), HasSubstr("two trajectories are called \"one\""));
  Candidate shorter = drive.perturbed_by("shorter", 0.01, 1);
  shorter.world_from_scan.world_from_scan.pop_back();
  EXPECT_THAT(message_for({one, shorter}), HasSubstr("shorter: 13 poses for 14 scans"));
}

}  // namespace
}  // namespace trysquare
