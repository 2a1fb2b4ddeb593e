// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/synthetic/memory_scans.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trysquare {

/// A disc that every scan of a plane world sees.
struct Disc {
  Eigen::Vector3d center_in_world;  ///< [m]
  Eigen::Vector3d normal_in_world;  ///< Unit.
};

/// How a plane world is seen: the setting of the paper's Lemmas 1 and 2.
struct PlaneWorldSettings {
  std::size_t points_per_disc = 300;  ///< In every scan, uniform on the disc, >= 1.
  double disc_radius_m = 1;           ///< > 0
  double point_sigma_m = 0.01;        ///< Standard deviation of the noise along the normal, >= 0.
  std::uint64_t seed = 0;

  /// @throws InvalidArgument  if a member is out of range.
  void validate() const;
};

/// One scan per true pose: points_per_disc fresh points of every disc, disc by disc, in the frame of the scan. Nothing
/// hides anything, so the theory of the paper holds to the letter.
///
/// @throws InvalidArgument  if a setting is out of range or a normal is not of length 1.
MemoryScans observe_discs(std::span<const Disc> discs, const Trajectory& true_poses,
                          const PlaneWorldSettings& settings);

/// `num_per_direction` discs in each of three perpendicular directions, their centers at least `spacing_m` apart, on a
/// grid whose cells are visited in a random order.
std::vector<Disc> orthogonal_discs(std::size_t num_per_direction, double spacing_m, std::uint64_t seed);

}  // namespace trysquare
