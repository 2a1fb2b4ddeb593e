// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/sensor_model.h"

#include "trysquare/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace trysquare {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;

double elevation_of(const Eigen::Vector3d& v) { return std::atan2(v.z(), v.head<2>().norm()); }
double azimuth_of(const Eigen::Vector3d& v) { return std::atan2(v.y(), v.x()); }

TEST(RayDirections, BeamsSpanTheElevationsEvenlyAndColumnsTheTurn) {
  const auto directions = ray_directions_in_scan(
      {.num_beams = 5, .num_azimuths = 8, .lowest_elevation_rad = -0.4, .highest_elevation_rad = 0.2});
  ASSERT_EQ(directions.size(), 40U);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_NEAR(directions[i].norm(), 1, 1e-15);
    EXPECT_NEAR(elevation_of(directions[i]), -0.4 + 0.15 * static_cast<double>(i / 8), 1e-14);
    EXPECT_NEAR(
        std::remainder(azimuth_of(directions[i]) - 45 * kDegrees * static_cast<double>(i % 8), 2 * std::numbers::pi), 0,
        1e-14);
  }
}

TEST(RayDirections, ANarrowViewReachesBothItsEdges) {
  const auto directions = ray_directions_in_scan({.num_beams = 1, .num_azimuths = 3, .horizontal_fov_rad = 1});
  EXPECT_NEAR(azimuth_of(directions[0]), -0.5, 1e-14);
  EXPECT_NEAR(azimuth_of(directions[1]), 0, 1e-14);
  EXPECT_NEAR(azimuth_of(directions[2]), 0.5, 1e-14);
  EXPECT_NEAR(elevation_of(directions[0]), -10 * kDegrees, 1e-7);  // of one beam: the middle of -30 and +10 degrees
}

TEST(RayDirections, OfAPinholeAreEvenlySpacedOnTheImagePlane) {
  SensorModel camera = sensor_preset("depth-camera");
  camera.num_beams = 3;
  camera.num_azimuths = 5;
  const auto directions = ray_directions_in_scan(camera);
  const double half_width = std::tan(31 * kDegrees);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Eigen::Vector3d on_plane = directions[i] / directions[i].x();
    EXPECT_NEAR(on_plane.y(), half_width * (-1 + 0.5 * static_cast<double>(i % 5)), 1e-14);
    EXPECT_NEAR(on_plane.z(), std::tan(24 * kDegrees) * (-1 + static_cast<double>(i / 5)), 1e-14);
  }
}

TEST(SensorPreset, EachHasTheRaysOfItsDataSheet) {
  const auto edges = [](const SensorModel& sensor) {
    const auto directions = ray_directions_in_scan(sensor);
    return std::pair(elevation_of(directions.front()) / kDegrees, elevation_of(directions.back()) / kDegrees);
  };
  const SensorModel carla = sensor_preset("carla32");
  EXPECT_EQ(carla.num_rays(), 32U * 720U);
  EXPECT_NEAR(edges(carla).first, -30, 1e-9);
  EXPECT_NEAR(edges(carla).second, 10, 1e-9);
  EXPECT_EQ(carla.max_range_m, 80);
  EXPECT_EQ(carla.range_sigma_m, 0.02);
  const SensorModel hdl = sensor_preset("hdl64");
  EXPECT_EQ(hdl.num_beams, 64);
  EXPECT_NEAR(edges(hdl).first, -24.8, 1e-9);
  EXPECT_NEAR(edges(hdl).second, 2, 1e-9);
  const SensorModel os1 = sensor_preset("os1-128");
  EXPECT_EQ(os1.num_rays(), 128U * 1024U);
  EXPECT_NEAR(edges(os1).second - edges(os1).first, 45, 1e-9);
  EXPECT_EQ(sensor_preset("depth-camera").pattern, RayPattern::kPinhole);
  for (const std::string_view name : sensor_preset_names()) EXPECT_NO_THROW(sensor_preset(name).validate()) << name;
  EXPECT_EQ(sensor_preset_names().size(), 4U);
}

TEST(SensorPreset, OfNoSuchNameListsThoseThatThereAre) {
  try {
    sensor_preset("hdl-64");
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_EQ(std::string(error.what()),
              "there is no sensor \"hdl-64\"; there are carla32, hdl64, os1-128, depth-camera");
  }
}

TEST(SensorModel, RefusesSettingsOutOfRange) {
  const std::vector<std::function<void(SensorModel&)>> mistakes = {
      [](SensorModel& s) { s.num_beams = 0; },
      [](SensorModel& s) { s.num_azimuths = 0; },
      [](SensorModel& s) { s.lowest_elevation_rad = -1.6; },
      [](SensorModel& s) { s.highest_elevation_rad = 1.6; },
      [](SensorModel& s) { s.highest_elevation_rad = -1; },
      [](SensorModel& s) { s.horizontal_fov_rad = 0; },
      [](SensorModel& s) { s.horizontal_fov_rad = 6.3; },
      [](SensorModel& s) { s.min_range_m = -1; },
      [](SensorModel& s) { s.max_range_m = s.min_range_m; },
      [](SensorModel& s) { s.max_range_m = std::numeric_limits<double>::infinity(); },
      [](SensorModel& s) { s.range_sigma_m = -1; },
      [](SensorModel& s) { s.dropout = 1.1; },
      [](SensorModel& s) { s.dropout = std::numeric_limits<double>::quiet_NaN(); },
      [](SensorModel& s) { s.period_s = 0; },
      [](SensorModel& s) {
        s.pattern = RayPattern::kPinhole;
        s.horizontal_fov_rad = 3.2;
      },
  };
  for (std::size_t i = 0; i < mistakes.size(); ++i) {
    SensorModel sensor;
    EXPECT_NO_THROW(sensor.validate());
    mistakes[i](sensor);
    EXPECT_THROW(sensor.validate(), InvalidArgument) << i;
  }
}

}  // namespace
}  // namespace trysquare
