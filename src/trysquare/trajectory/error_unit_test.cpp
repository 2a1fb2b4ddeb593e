// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/error_unit.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

#include <numbers>

namespace trysquare {
namespace {

TrajectoryErrors errors_in(std::string_view unit) {
  TrajectoryErrors errors{.errors = {1, 3}};
  errors.unit = unit;
  return errors;
}

TEST(ChangeUnit, ScalesErrorsAndStatistics) {
  TrajectoryErrors errors = errors_in("m");
  change_unit(errors, "cm");
  EXPECT_EQ(errors.errors, (std::vector<double>{100, 300}));
  EXPECT_DOUBLE_EQ(errors.statistics.mean, 200);
  EXPECT_DOUBLE_EQ(errors.statistics.sse, 1e5);
  EXPECT_EQ(errors.unit, "cm");
  change_unit(errors, "km");
  EXPECT_DOUBLE_EQ(errors.statistics.max, 0.003);
}

TEST(ChangeUnit, TurnsDegreesIntoRadiansAndBack) {
  TrajectoryErrors errors = errors_in("deg");
  change_unit(errors, "rad");
  EXPECT_DOUBLE_EQ(errors.errors[0], std::numbers::pi / 180);
  change_unit(errors, "deg");
  EXPECT_DOUBLE_EQ(errors.errors[0], 1);
}

TEST(ChangeUnit, RefusesOtherKindsAndUnknownUnits) {
  for (const char* unit : {"deg", "parsec", "%", "unit-less"}) {
    TrajectoryErrors errors = errors_in("m");
    EXPECT_THROW(change_unit(errors, unit), InvalidArgument) << unit;
  }
  TrajectoryErrors errors = errors_in("unit-less");
  EXPECT_THROW(change_unit(errors, "m"), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
