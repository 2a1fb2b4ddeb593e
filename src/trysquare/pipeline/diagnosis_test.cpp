// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/diagnosis.h"

#include "trysquare/core/error.h"
#include "trysquare/core/handedness.h"
#include "trysquare/simulation/drive.h"
#include "trysquare/simulation/sensor_model.h"
#include "trysquare/simulation/simulated_scans.h"
#include "trysquare/simulation/simulated_world.h"
#include "trysquare/synthetic/memory_scans.h"
#include "trysquare/synthetic/perturb.h"
#include "trysquare/synthetic/rectangle.h"
#include "trysquare/synthetic/spinning_sensor.h"
#include "trysquare/synthetic/street_corner.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr std::size_t kNumScans = 12;
constexpr std::int64_t kInterval_ns = 100'000'000;

/// A drive that weaves and speeds up: neither its speed nor its turn is steady.
Pose weaving(double time_s) {
  const double heading = 0.15 * std::sin(4 * time_s);
  const double pitch = 0.02 * std::sin(6 * time_s);
  return {.rotation = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                      Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()).toRotationMatrix(),
          .translation = {4 * time_s + 2 * time_s * time_s, 0.5 * std::sin(3 * time_s), 0}};
}

/// Poses at the times of the scans plus `late_s`, with the stamps of the scans.
Trajectory weaving_drive(double late_s = 0) {
  Trajectory drive;
  for (std::size_t i = 0; i < kNumScans; ++i) {
    drive.world_from_scan.push_back(weaving(0.1 * static_cast<double>(i) + late_s));
    drive.stamps_ns.push_back(static_cast<std::int64_t>(i) * kInterval_ns);
  }
  return drive;
}

/// The street corner with more that faces its direction: a wall behind, and fronts that stand out from the facades.
std::vector<Rectangle> street() {
  std::vector<Rectangle> scene = street_corner_scene();
  scene.push_back({{-14, -7, -1.8}, {0, 15, 0}, {0, 0, 12}});
  for (const double x : {-9.0, -3.0, 4.0, 10.0}) {
    const std::vector<Rectangle> porch = box({x, 6.2, -1.8}, {1.5, 1.8, 4});
    scene.insert(scene.end(), porch.begin(), porch.end());
  }
  return scene;
}

/// From scan `changed_from` on a hoarding before the right facade stands `moved_m` nearer to it.
MemoryScans scans_of(const Trajectory& drive, std::size_t changed_from = kNumScans, double moved_m = 0) {
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    std::vector<Rectangle> scene = street();
    if (changed_from < kNumScans) {
      const double y = -6.5 - (i >= changed_from ? moved_m : 0);
      scene.push_back({{-3, y, -1.8}, {9, 0, 0}, {0, 0, 5}});
    }
    Random random(7, i);
    const SpinningSensor sensor{.num_beams = 32, .num_azimuths = 480};
    scans.push_back(cast_scan(scene, drive.world_from_scan[i], sensor, random));
  }
  return MemoryScans(std::move(scans));
}

const MemoryScans& weaving_scans() {
  static const MemoryScans scans = scans_of(weaving_drive());
  return scans;
}

/// Of errors and warnings.
std::vector<std::string> alarms_of(const Diagnosis& diagnosis) {
  std::vector<std::string> ids;
  for (const Finding& finding : diagnosis.findings) {
    if (finding.severity != Severity::kNote) ids.push_back(finding.id);
  }
  return ids;
}

TEST(Diagnose, RaisesNoAlarmOverTruePoses) {
  const Diagnosis found = diagnose(weaving_scans(), weaving_drive());
  EXPECT_THAT(alarms_of(found), IsEmpty());
  EXPECT_THAT(found.suspects.poses, IsEmpty());
  EXPECT_THAT(found.jumps, IsEmpty());
  EXPECT_THAT(found.ghost_walls, IsEmpty());
  EXPECT_FALSE(found.time_offset.offset_s);
  EXPECT_TRUE(found.reason.empty());
}

TEST(Diagnose, NamesAnOffsetInTimeOf50Milliseconds) {
  for (const double late_s : {0.05, -0.05}) {
    const Diagnosis found = diagnose(weaving_scans(), weaving_drive(late_s));
    EXPECT_THAT(alarms_of(found), ElementsAre("time_offset")) << found.time_offset.reason;
    EXPECT_NEAR(found.time_offset.offset_s.value_or(0), -late_s, 0.005);
    EXPECT_LT(found.time_offset.resolution_s.value_or(1), 0.02);
  }
}

TEST(Diagnose, DoesNotTakeRandomErrorsForAnOffsetInTime) {
  const Trajectory noisy =
      perturb(weaving_drive(), {.translation_sigma_m = 0.05, .rotation_sigma_rad = 0.003, .seed = 3});
  const Diagnosis found = diagnose(weaving_scans(), noisy);
  EXPECT_THAT(alarms_of(found), Not(Contains("time_offset")));
  EXPECT_FALSE(found.time_offset.offset_s);
  EXPECT_THAT(found.time_offset.reason, HasSubstr("no offset explains"));
}

TEST(Diagnose, NamesThePoseThatStandsOut) {
  Trajectory poses = perturb(weaving_drive(), {.translation_sigma_m = 0.005, .seed = 4});
  poses.world_from_scan[9].translation += Eigen::Vector3d(0.02, 0.1, 0);
  const Diagnosis found = diagnose(weaving_scans(), poses);
  ASSERT_EQ(found.suspects.poses.size(), 1U);
  const SuspectPose& suspect = found.suspects.poses.front();
  EXPECT_EQ(suspect.scan, 9U);
  EXPECT_NEAR(suspect.translation_m, 0.102, 0.02);
  EXPECT_LT(suspect.translation_interval_m[0], suspect.translation_m);
  EXPECT_GT(suspect.translation_interval_m[0], 0.05);
  EXPECT_THAT(found.jumps, IsEmpty()) << "both steps are those of the pose";
}

TEST(Diagnose, NamesAWallThatMovedByTenCentimetres) {
  const MemoryScans scans = scans_of(weaving_drive(), 6, 0.1);
  const Diagnosis found = diagnose(scans, weaving_drive());
  ASSERT_FALSE(found.ghost_walls.empty());
  const GhostWall& wall = found.ghost_walls.front();
  EXPECT_NEAR(wall.distance_m, 0.1, 0.01);
  EXPECT_GT(std::abs(wall.normal_in_map.y()), 0.99);
  EXPECT_NEAR(wall.center_in_map.y(), -6.55, 0.1);
  EXPECT_GT(wall.adjusted_m.value_or(0), 0.5 * wall.distance_m) << "no poses put it into one place";
  const bool upper_is_before = wall.normal_in_map.y() > 0;
  EXPECT_THAT(upper_is_before ? wall.upper_scans : wall.lower_scans, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(upper_is_before ? wall.lower_scans : wall.upper_scans, ElementsAre(6, 7, 8, 9, 10, 11));
}

TEST(Diagnose, SaysThatAGhostWallComesFromThePosesAndWhereTheyJump) {
  Trajectory poses = weaving_drive();
  for (std::size_t i = 6; i < kNumScans; ++i) poses.world_from_scan[i].translation.y() += 0.1;
  const Diagnosis found = diagnose(weaving_scans(), poses);
  ASSERT_FALSE(found.ghost_walls.empty());
  EXPECT_NEAR(found.ghost_walls.front().distance_m, 0.1, 0.01);
  EXPECT_LT(found.ghost_walls.front().adjusted_m.value_or(1), 0.02);
  ASSERT_EQ(found.jumps.size(), 1U);
  EXPECT_EQ(found.jumps.front().from, 5U);
  EXPECT_NEAR(found.jumps.front().translation_m, 0.1, 0.01);
}

TEST(Diagnose, NamesPosesOfTheOtherHandedness) {
  const Diagnosis found = diagnose(weaving_scans(), with_y_negated(weaving_drive()));
  EXPECT_THAT(alarms_of(found), ElementsAre("left_handed"));
  EXPECT_FALSE(found.blame_reason.empty()) << "what else there is would be an echo";
}

TEST(Diagnose, LeavesTheFineOutWhileAFrameIsWrong) {
  Trajectory inverted = weaving_drive();
  for (Pose& pose : inverted.world_from_scan) pose = rigid_inverse(pose);
  const Diagnosis found = diagnose(weaving_scans(), inverted);
  EXPECT_THAT(alarms_of(found), ElementsAre("poses_inverted"));
  EXPECT_FALSE(found.estimate);
  EXPECT_THAT(found.suspects_reason, HasSubstr("poses_inverted"));
}

TEST(Diagnose, NamesThePoseBesideThePathWhenTheScansSayNothing) {
  Trajectory poses = weaving_drive();
  poses.world_from_scan[7].translation.y() += 5;
  const Diagnosis found = diagnose(weaving_scans(), poses);
  ASSERT_EQ(found.estimate.value().status, EstimateStatus::kRefused);
  EXPECT_FALSE(found.suspects_reason.empty());
  ASSERT_EQ(found.off_path.size(), 1U);
  EXPECT_EQ(found.off_path.front().scan, 7U);
  EXPECT_NEAR(found.off_path.front().distance_m, 5, 0.1);
}

/// One pose has settled metres beside the others, and the two halves of the patches agree on it to a millimetre.
TEST(Diagnose, DoesNotCallPosesCoarseThatSlidePastEachOther) {
  const SimulatedWorld grid = make_world(WorldStyle::kTownGrid, 2);
  const Trajectory truth = drive(grid, {.num_scans = 10, .seed = 2});
  const SimulatedScans scans(grid, truth, sensor_preset("carla32"), 2);
  const double degree = std::numbers::pi / 180;
  const Trajectory given = perturb(truth, {.translation_sigma_m = 1, .rotation_sigma_rad = degree, .seed = 8});
  const Diagnosis found = diagnose(scans, given);
  ASSERT_TRUE(found.estimate);
  ASSERT_EQ(found.estimate->status, EstimateStatus::kRefused);
  ASSERT_LT(found.estimate->half_difference_m.value(), 0.1);
  EXPECT_THAT(alarms_of(found), Contains("poses_unclear"));
}

TEST(Diagnose, SaysThatTwoScansAreTooFew) {
  const SyntheticSequence two =
      simulate_street_corner({.num_scans = 2, .sensor = {.num_beams = 8, .num_azimuths = 90}});
  const Diagnosis found = diagnose(two.scans, two.trajectory);
  EXPECT_THAT(found.reason, HasSubstr("too few"));
  EXPECT_THAT(found.findings, IsEmpty());
}

TEST(Diagnose, SaysThatThereIsNoFlatSurface) {
  std::vector<Scan> scans(4);
  Random random(1, 0);
  for (Scan& scan : scans) {
    for (int i = 0; i < 300; ++i) scan.points_in_scan.emplace_back(random.normal(), random.normal(), random.normal());
  }
  const Diagnosis found = diagnose(MemoryScans(scans), Trajectory{.world_from_scan = std::vector<Pose>(4)});
  EXPECT_THAT(found.reason, HasSubstr("no scan has a flat surface"));
}

TEST(Diagnose, IsTheSameForEveryNumberOfThreads) {
  Trajectory poses = perturb(weaving_drive(), {.translation_sigma_m = 0.01, .seed = 4});
  for (std::size_t i = 6; i < kNumScans; ++i) poses.world_from_scan[i].translation.y() += 0.1;
  const Diagnosis one = diagnose(weaving_scans(), poses, {}, {}, {.num_threads = 1});
  const Diagnosis four = diagnose(weaving_scans(), poses, {}, {}, {.num_threads = 4});
  ASSERT_EQ(one.findings.size(), four.findings.size());
  for (std::size_t i = 0; i < one.findings.size(); ++i) EXPECT_EQ(one.findings[i].message, four.findings[i].message);
  EXPECT_EQ(one.time_offset.best.value().error_m, four.time_offset.best.value().error_m);
  ASSERT_FALSE(one.ghost_walls.empty());
  EXPECT_EQ(one.ghost_walls.front().distance_m, four.ghost_walls.front().distance_m);
}

TEST(Diagnose, RefusesSettingsOutOfRange) {
  EXPECT_THROW(diagnose(weaving_scans(), weaving_drive(), {.radius_m = 0}), InvalidArgument);
  EXPECT_THROW(diagnose(weaving_scans(), weaving_drive(), {.max_time_offset_s = -1}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
