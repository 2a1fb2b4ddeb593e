// SPDX-License-Identifier: Apache-2.0
#include "trysquare/experiments/simulated_drive.h"

#include "trysquare/core/error.h"
#include "trysquare/simulation/drive.h"
#include "trysquare/simulation/sensor_model.h"
#include "trysquare/simulation/simulated_world.h"

#include <fmt/format.h>

#include <utility>

namespace trysquare {
namespace {

WorldStyle style_of(std::string_view scene) {
  if (scene == "street") return WorldStyle::kStreet;
  constexpr std::array kStyles = {WorldStyle::kTownGrid, WorldStyle::kTownSuburb, WorldStyle::kTownOld};
  for (std::size_t i = 0; i < kStyles.size(); ++i) {
    if (scene == kSimulatedTowns.at(i)) return kStyles.at(i);
  }
  throw InvalidArgument(
      fmt::format("scene = {} is out of range: it must be street, {}", scene, fmt::join(kSimulatedTowns, ", ")));
}

}  // namespace

std::unique_ptr<SimulatedScans> simulated_drive(std::string_view scene, std::uint64_t seed, std::size_t num_scans) {
  const SimulatedWorld world = make_world(style_of(scene), seed);
  Trajectory true_poses = drive(world, {.num_scans = num_scans, .seed = seed});
  return std::make_unique<SimulatedScans>(world, std::move(true_poses), sensor_preset(kDriveSensor), seed);
}

std::vector<OrthogonalWindow> extraction_along_drive(std::string_view scene, std::uint64_t seed, std::size_t num_scans,
                                                     double radius_m, const OrthogonalSubsetSettings& settings,
                                                     const Execution& execution) {
  const auto scans = simulated_drive(scene, seed, num_scans);
  return orthogonal_windows(*scans, scans->true_poses(), 1, 1, radius_m, settings, execution);
}

}  // namespace trysquare
