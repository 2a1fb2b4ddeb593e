// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/orthogonal_windows.h"

#include "trysquare/core/error.h"
#include "trysquare/synthetic/memory_scans.h"
#include "trysquare/synthetic/street_corner.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace trysquare {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

SyntheticSequence street(std::size_t num_scans) {
  return simulate_street_corner({.num_scans = num_scans, .sensor = {.num_beams = 64, .num_azimuths = 900}});
}

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) / kDegree;
}

TEST(OrthogonalWindows, AreOneEveryStrideAndLeaveOutAShortLast) {
  const SyntheticSequence truth = street(6);
  const auto windows = orthogonal_windows(truth.scans, truth.trajectory, 2, 3, 1.0);
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_EQ(windows[0].first, 0u);
  EXPECT_EQ(windows[0].last, 1u);
  EXPECT_EQ(windows[1].first, 3u);
  EXPECT_EQ(windows[1].last, 4u);
  EXPECT_TRUE(orthogonal_windows(truth.scans, truth.trajectory, 7, 1, 1.0).empty());
}

// The sensor turns, and so do the directions in the frame of each window's first scan; not in that of scan 0.
TEST(OrthogonalWindows, HaveTheirNormalsInTheFrameOfTheFirstScan) {
  SyntheticSequence truth = street(3);
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < truth.scans.size(); ++i) {
    const Pose turned{
        Eigen::AngleAxisd(0.3 * static_cast<double>(i), Eigen::Vector3d(0.2, -0.1, 1).normalized()).toRotationMatrix(),
        Eigen::Vector3d::Zero()};
    scans.push_back(truth.scans.load(i));
    for (Eigen::Vector3d& point : scans.back().points_in_scan) point = rigid_inverse(turned) * point;
    truth.trajectory.world_from_scan[i] = truth.trajectory.world_from_scan[i] * turned;
  }
  const auto windows = orthogonal_windows(MemoryScans(scans), truth.trajectory, 1, 1, 1.0);
  ASSERT_EQ(windows.size(), 3u);
  for (const OrthogonalWindow& window : windows) {
    ASSERT_EQ(window.directions.size(), 3u);
    EXPECT_TRUE(window.reason.empty());
    for (const OrthogonalWindow::Direction& direction : window.directions) {
      double nearest_deg = 90;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        nearest_deg = std::min(nearest_deg, angle_deg(direction.normal_in_map, Eigen::Matrix3d::Identity().col(axis)));
      }
      EXPECT_LT(nearest_deg, 0.5);
    }
  }
}

TEST(OrthogonalWindows, SayHowFarDirectionsMoved) {
  SyntheticSequence truth = street(3);
  // The pose of scan 1 is turned by 2 degrees about z: its two upright directions move, there and back.
  truth.trajectory.world_from_scan[1].rotation =
      Eigen::AngleAxisd(2 * kDegree, Eigen::Vector3d::UnitZ()) * truth.trajectory.world_from_scan[1].rotation;
  const auto windows = orthogonal_windows(truth.scans, truth.trajectory, 1, 1, 1.0);
  for (const OrthogonalWindow::Direction& direction : windows[0].directions) EXPECT_FALSE(direction.moved_rad);
  for (const std::size_t i : {1U, 2U}) {
    for (const OrthogonalWindow::Direction& direction : windows[i].directions) {
      const double expected_deg = std::abs(direction.normal_in_map.z()) > 0.9 ? 0.0 : 2.0;
      EXPECT_NEAR(direction.moved_rad.value() / kDegree, expected_deg, 0.3);
    }
  }
  EXPECT_NEAR(largest_move_rad(windows).value() / kDegree, 2.0, 0.3);
  EXPECT_FALSE(largest_move_rad({windows[0]}));
}

TEST(OrthogonalWindows, RefuseWhatMakesNoSense) {
  const SyntheticSequence truth = street(2);
  EXPECT_THROW(orthogonal_windows(truth.scans, truth.trajectory, 0, 1, 1.0), InvalidArgument);
  EXPECT_THROW(orthogonal_windows(truth.scans, truth.trajectory, 1, 0, 1.0), InvalidArgument);
  EXPECT_THROW(orthogonal_windows(truth.scans, {}, 1, 1, 1.0), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
