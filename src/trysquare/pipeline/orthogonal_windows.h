// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/metrics/extract_orthogonal_subset.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// What the scans [first, last] alone say about the orthogonal directions of the scene.
struct OrthogonalWindow {
  struct Direction {
    Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();  ///< Unit, in the frame of scan 0 of the sequence.
    std::size_t num_points = 0;
    /// Angle to the nearest direction of the window before [rad]; nullopt when there is none within 45°.
    std::optional<double> moved_rad;
  };
  std::size_t first = 0;
  std::size_t last = 0;
  std::vector<Direction> directions;  ///< 0 to 3, most points first.
  std::string reason;                 ///< Why there are fewer than three; empty otherwise.
  std::size_t num_points = 0;         ///< Points looked at.
  std::size_t num_planar = 0;         ///< Of these, on a plane.
};

/// Extracts the orthogonal subset of every window of consecutive scans, each for itself: are the directions the same
/// all along, how many points do they get? Windows of one scan give the statistics of the paper.
///
/// @param window    Scans in a window, >= 1.
/// @param stride    Scans from one window to the next, >= 1. A last window that would be short is left out.
/// @param radius_m  See extract_orthogonal_subset().
/// @throws InvalidArgument  if an argument is out of range, or the numbers of scans and poses differ.
/// @throws IoError          from ScanSequence::load().
std::vector<OrthogonalWindow> orthogonal_windows(const ScanSequence& scans, const Trajectory& trajectory,
                                                 std::size_t window, std::size_t stride, double radius_m,
                                                 const OrthogonalSubsetSettings& settings = {},
                                                 const Execution& execution = {});

/// The largest angle that any direction moved from one window to the next [rad]; nullopt when none can be compared.
std::optional<double> largest_move_rad(const std::vector<OrthogonalWindow>& windows);

}  // namespace trysquare
