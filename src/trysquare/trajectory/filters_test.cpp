// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/filters.h"

#include "trysquare/core/error.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace trysquare {
namespace {

using testing::ElementsAre;

/// Poses at these places on a line, turned by these angles, one a nanosecond.
Trajectory at(const std::vector<double>& places_m, const std::vector<double>& angles_rad = {}) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    const double angle_rad = angles_rad.empty() ? 0 : angles_rad[i];
    trajectory.world_from_scan.push_back(
        {Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {places_m[i], 0, 0}});
    trajectory.stamps_ns.push_back(static_cast<std::int64_t>(i));
  }
  return trajectory;
}

TEST(Downsampled, SpreadsEvenlyAndKeepsTheEnds) {
  const Trajectory eight = at({0, 1, 2, 3, 4, 5, 6, 7});
  EXPECT_THAT(downsampled(eight, 4).stamps_ns, ElementsAre(0, 2, 4, 7));  // numpy.linspace(0, 7, 4, dtype=int)
  EXPECT_THAT(downsampled(eight, 3).stamps_ns, ElementsAre(0, 3, 7));
  EXPECT_THAT(downsampled(eight, 1).stamps_ns, ElementsAre(0));
  EXPECT_EQ(downsampled(eight, 9).size(), 8u);
  EXPECT_THROW(downsampled(eight, 0), InvalidArgument);
}

TEST(MotionFiltered, KeepsWhatMovedAlongThePathOrTurned) {
  EXPECT_THAT(motion_filtered(at({0, 0.4, 1, 0.5, 0, 0}), 1, 9).stamps_ns, ElementsAre(0, 2, 4));
  EXPECT_THAT(motion_filtered(at({0, 0, 0, 0, 0}, {0, 0.3, 0.5, 0.6, 1.1}), 1, 0.5).stamps_ns, ElementsAre(0, 2, 4));
  EXPECT_THROW(motion_filtered(at({0}), -1, 0), InvalidArgument);
  EXPECT_THROW(motion_filtered(at({0}), 0, -1), InvalidArgument);
}

TEST(InTimeRange, IsInclusiveAtBothEnds) {
  const Trajectory five = at({0, 1, 2, 3, 4});
  EXPECT_THAT(in_time_range(five, 1, 3).stamps_ns, ElementsAre(1, 2, 3));
  EXPECT_THAT(in_time_range(five, 3, {}).stamps_ns, ElementsAre(3, 4));
  EXPECT_THAT(in_time_range(five, {}, 0).stamps_ns, ElementsAre(0));
  EXPECT_THROW(in_time_range(five, 9, {}), InvalidArgument);
  Trajectory without = five;
  without.stamps_ns.clear();
  EXPECT_THROW(in_time_range(without, 1, 3), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
