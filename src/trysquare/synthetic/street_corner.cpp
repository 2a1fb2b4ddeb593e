// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/street_corner.h"

#include "trysquare/core/error.h"

#include <Eigen/Geometry>

#include <cmath>
#include <string>
#include <utility>

namespace trysquare {
namespace {

constexpr std::int64_t kScanPeriodNs = 100'000'000;

Trajectory curve(const StreetCornerSettings& settings) {
  Trajectory trajectory;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < settings.num_scans; ++i) {
    const double heading = static_cast<double>(i) * settings.turn_per_step_rad;
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    trajectory.world_from_scan.push_back({rotation, position});
    trajectory.stamps_ns.push_back(static_cast<std::int64_t>(i) * kScanPeriodNs);
    position += settings.step_m * rotation.col(0);
  }
  return trajectory;
}

}  // namespace

void StreetCornerSettings::validate() const {
  if (num_scans < 1) throw InvalidArgument("num_scans = 0 is out of range: it must be >= 1");
  if (!(step_m > 0 && std::isfinite(step_m))) {
    throw InvalidArgument("step_m = " + std::to_string(step_m) + " is out of range: it must be > 0");
  }
  if (!std::isfinite(turn_per_step_rad)) throw InvalidArgument("turn_per_step_rad is out of range: it must be finite");
  sensor.validate();
}

std::vector<Rectangle> street_corner_scene() {
  const double ground = -1.8;
  const Eigen::Vector3d up(0, 0, 12);
  std::vector<Rectangle> scene{
      {{-30, -40, ground}, {54, 0, 0}, {0, 80, 0}},  // ground
      {{-30, 8, ground}, {42, 0, 0}, up},            // left facade, ends at the corner ...
      {{12, 8, ground}, {0, 32, 0}, up},             // ... and goes on along the street that crosses
      {{-30, -7, ground}, {39, 0, 0}, up},           // right facade
      {{9, -7, ground}, {0, -33, 0}, up},            // its corner
      {{24, -40, ground}, {0, 80, 0}, up},           // the facade across, ahead
  };
  for (const double x : {-7.0, 2.0}) {
    const std::vector<Rectangle> car = box({x, -5.5, ground}, {4.2, 1.8, 1.5});
    scene.insert(scene.end(), car.begin(), car.end());
  }
  return scene;
}

SyntheticSequence simulate_street_corner(const StreetCornerSettings& settings) {
  settings.validate();
  const std::vector<Rectangle> scene = street_corner_scene();
  Trajectory trajectory = curve(settings);
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < settings.num_scans; ++i) {
    Random random(settings.seed, i);
    scans.push_back(cast_scan(scene, trajectory.world_from_scan[i], settings.sensor, random));
    scans.back().stamp_ns = trajectory.stamps_ns[i];
  }
  return {MemoryScans(std::move(scans)), std::move(trajectory)};
}

}  // namespace trysquare
