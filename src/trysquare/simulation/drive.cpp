// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/drive.h"

#include "trysquare/simulation/internal/polyline.h"
#include "trysquare/simulation/internal/require.h"
#include "trysquare/synthetic/random.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace trysquare {
namespace {

using internal::Polyline;

constexpr std::uint64_t kDriveStream = 0x6472697665;  ///< "drive": other numbers than the world and the noise.
constexpr double kStepVariation = 0.1;
constexpr double kLookAhead_m = 1.5;

/// How far to the left of the route: two slow waves, so that the heading moves, too.
double sway(const DriveSettings& settings, double phase, double s_m) {
  const double turn = 2 * std::numbers::pi * s_m;
  return settings.sway_m * (0.7 * std::sin(turn / 41 + phase) + 0.3 * std::sin(turn / 17 + 2.3 * phase));
}

Eigen::Vector3d position(const Polyline& route, const DriveSettings& settings, double phase, double s_m) {
  const Eigen::Vector3d left = internal::rotation_looking(route.ahead(s_m, kLookAhead_m)).col(1);
  return route.at(s_m) + sway(settings, phase, s_m) * left;
}

/// ahead_from_scan: how the sensor is mounted.
Eigen::Matrix3d mounting(const DriveSettings& settings) {
  return (Eigen::AngleAxisd(settings.look_left_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(settings.look_down_rad, Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

Pose pose_at(const Polyline& route, const DriveSettings& settings, double phase, double s_m, Random& random) {
  constexpr double kReach_m = 0.5;
  const Eigen::Vector3d at = position(route, settings, phase, s_m);
  const Eigen::Vector3d forward =
      position(route, settings, phase, s_m + kReach_m) - position(route, settings, phase, s_m - kReach_m);
  const double roll = settings.tilt_sigma_rad * random.normal();
  const double pitch = settings.tilt_sigma_rad * random.normal();
  const double heave = settings.heave_sigma_m * random.normal();
  const Eigen::Matrix3d tilt =
      (Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  return {internal::rotation_looking(forward.normalized()) * tilt * mounting(settings),
          at + heave * Eigen::Vector3d::UnitZ()};
}

Polyline route_of(const SimulatedWorld& world) {
  if (world.route_in_world.size() < 2) throw InvalidArgument("this world has no route: poses must be given");
  return {world.route_in_world, world.route_is_loop};
}

}  // namespace

void DriveSettings::validate() const {
  using internal::require;
  require(num_scans >= 1, "num_scans", static_cast<double>(num_scans), ">= 1");
  require(step_m > 0 && std::isfinite(step_m), "step_m", step_m, "> 0");
  require(period_s > 0 && std::isfinite(period_s), "period_s", period_s, "> 0");
  require(sway_m >= 0 && std::isfinite(sway_m), "sway_m", sway_m, ">= 0");
  require(heave_sigma_m >= 0 && std::isfinite(heave_sigma_m), "heave_sigma_m", heave_sigma_m, ">= 0");
  require(tilt_sigma_rad >= 0 && std::isfinite(tilt_sigma_rad), "tilt_sigma_rad", tilt_sigma_rad, ">= 0");
  require(std::isfinite(look_left_rad), "look_left_rad", look_left_rad, "finite");
  require(std::abs(look_down_rad) < std::numbers::pi / 2, "look_down_rad", look_down_rad, "within pi/2 of level");
}

Trajectory drive(const SimulatedWorld& world, const DriveSettings& settings) {
  constexpr double kNanosecondsPerSecond = 1e9;
  settings.validate();
  const Polyline route = route_of(world);
  const double phase = 2 * std::numbers::pi * Random(settings.seed, kDriveStream).uniform();
  Trajectory trajectory;
  double s_m = 0;
  for (std::size_t i = 0; i < settings.num_scans; ++i) {
    if (!route.is_loop() && s_m > route.length_m()) {
      throw InvalidArgument("the route of " + std::to_string(route.length_m()) + " m ends after " + std::to_string(i) +
                            " scans of " + std::to_string(settings.num_scans));
    }
    Random random(settings.seed, kDriveStream + 1 + i);
    trajectory.world_from_scan.push_back(pose_at(route, settings, phase, s_m, random));
    trajectory.stamps_ns.push_back(std::llround(static_cast<double>(i) * settings.period_s * kNanosecondsPerSecond));
    s_m += settings.step_m * (1 + kStepVariation * (2 * random.uniform() - 1));
  }
  return trajectory;
}

double length_of_route_m(const SimulatedWorld& world) {
  const Polyline route = route_of(world);
  return route.is_loop() ? std::numeric_limits<double>::infinity() : route.length_m();
}

}  // namespace trysquare
