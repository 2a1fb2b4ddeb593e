// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/synthetic/memory_scans.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace trysquare {

/// A disc that every scan of a plane world sees.
struct Disc {
  Eigen::Vector3d center_in_world;          ///< [m]
  Eigen::Vector3d normal_in_world;          ///< Unit.
  std::optional<std::size_t> num_points{};  ///< Of this disc in every scan, >= 1; empty: points_per_disc.
};

/// How a plane world is seen: the setting of the paper's Lemmas 1 and 2.
struct PlaneWorldSettings {
  std::size_t points_per_disc = 300;  ///< In every scan, uniform on the disc, >= 1; a disc may have its own number.
  double disc_radius_m = 1;           ///< > 0
  double point_sigma_m = 0.01;        ///< Standard deviation of the noise along the normal, >= 0.
  std::uint64_t seed = 0;

  /// @throws InvalidArgument  if a member is out of range.
  void validate() const;
};

/// One scan per true pose: fresh points of every disc, disc by disc, in the frame of the scan. Nothing
/// hides anything, so the theory of the paper holds to the letter.
///
/// @throws InvalidArgument  if a setting is out of range a normal is not of length 1, or a disc has 0 points.
MemoryScans observe_discs(std::span<const Disc> discs, const Trajectory& true_poses,
                          const PlaneWorldSettings& settings);

/// `num_per_direction` discs in each of three perpendicular directions, their centers at least `spacing_m` apart, on a
/// grid whose cells are visited in a random order.
std::vector<Disc> orthogonal_discs(std::size_t num_per_direction, double spacing_m, std::uint64_t seed);

/// A random plane world of the paper's §V-A1: discs 0, 1, 2 face the axes x, y, z; 0 to 7 more face directions of
/// uniform polar angles. Centers are uniform in ±10 m, 3.2 m apart at least, so that neither the discs (1 m) nor the
/// neighborhoods on them (1 m) meet; each has round(density · π) points, of a density uniform in 30 to 100 per m².
///
/// Differs: uniform polar angles favor the poles. That is how the paper draws them, and it is kept.
std::vector<Disc> random_plane_world(std::uint64_t seed);

/// The paper's three planes that show what each metric can and cannot do.
enum class Counterexample {
  kBalanced,       ///< Perpendicular, 60 points per m² on each.
  kUnbalanced,     ///< Perpendicular, 20, 60 and 300 points per m².
  kNonOrthogonal,  ///< Their normals are 35° and 50° off the first, in two planes; 60 points per m² on each.
};

/// "balanced", "unbalanced", "non-orthogonal".
std::string_view name_of(Counterexample counterexample);

/// Three discs of 1 m, 6 m from the origin along each axis, with round(density · π) points each.
std::vector<Disc> counterexample_discs(Counterexample counterexample);

}  // namespace trysquare
