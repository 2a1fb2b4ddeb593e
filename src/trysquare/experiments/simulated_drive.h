// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/metrics/extract_orthogonal_subset.h"
#include "trysquare/pipeline/orthogonal_windows.h"
#include "trysquare/simulation/simulated_scans.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace trysquare {

/// The sensor of all simulated drives: CARLA's, 32 beams from -30 to +10 degrees.
inline constexpr std::string_view kDriveSensor = "carla32";

/// The three towns of the paper's experiment, as far as worlds of our own can stand for CARLA's.
inline constexpr std::array<std::string_view, 3> kSimulatedTowns = {"town-grid", "town-suburb", "town-old"};

/// Scans of a drive through a world drawn at random.
/// @param scene      "street", or one of kSimulatedTowns.
/// @param seed       Of world, drive and noise.
/// @param num_scans  >= 1, about a metre apart.
/// @throws InvalidArgument  if there is no such scene, or its route is too short.
std::unique_ptr<SimulatedScans> simulated_drive(std::string_view scene, std::uint64_t seed, std::size_t num_scans);

/// The orthogonal subset of every scan of a long drive, each by itself: what the paper's figure about the extraction
/// shows. See orthogonal_windows().
std::vector<OrthogonalWindow> extraction_along_drive(std::string_view scene, std::uint64_t seed, std::size_t num_scans,
                                                     double radius_m, const OrthogonalSubsetSettings& settings = {},
                                                     const Execution& execution = {});

}  // namespace trysquare
