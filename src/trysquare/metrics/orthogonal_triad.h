// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trysquare {

/// What counts as a direction, and what as chance.
struct OrthogonalTriadSettings {
  double tolerance_rad = 0.175;       ///< A normal belongs to a direction up to this angle from its mean; in (0, π/8].
  double max_offset_rad = 0.04;       ///< A mean is up to this angle, plus its spread, from its axis; in (0, π/8].
  double min_support = 12;            ///< Weight of a direction's normals above the background; > 0.
  double min_contrast = 1.5;          ///< Weight of a direction's normals / background; > 1.
  double min_significance = 5;        ///< (Weight − background) / sqrt(background), in standard deviations; > 0.
  double max_chance_of_pair = 0.4;    ///< Pairs as square as the one found that random modes would give; > 0.
  double max_chance_of_triad = 0.02;  ///< Likewise triads; > 0.

  void validate() const;  ///< @throws InvalidArgument
};

/// One direction that many normals share.
struct TriadDirection {
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();         ///< Unit; its last component that is not 0 is positive.
  Eigen::Vector3d mean_normal = Eigen::Vector3d::Zero();  ///< The mode of its normals; unit, sign likewise.
  std::size_t num_normals = 0;                            ///< Within the tolerance of the mean normal.
  double support = 0;                                     ///< Their weight.
  double background = 0;  ///< Weight that would be there if normals were as dense as just outside the tolerance.
  double spread_rad = 0;  ///< Root mean square of the angles between them and the mean normal.
  double offset_rad = 0;  ///< Angle between mean normal and axis.
};

/// Which direction a normal belongs to when it belongs to none.
inline constexpr std::uint8_t kNoDirection = 3;

/// Up to three mutually orthogonal directions.
struct OrthogonalTriad {
  std::vector<TriadDirection> directions;         ///< 0 to 3, most support first; orthonormal axes.
  std::vector<std::uint8_t> direction_of_normal;  ///< Of every normal the index of its direction, or kNoDirection.
  std::size_t num_modes = 0;                      ///< Directions that stand out, orthogonal to another or not.
  double chance = 0;                              ///< Expected number of triads, or pairs, like this one by chance.
};

/// Finds the up to three mutually orthogonal directions that the most normals share.
///
/// (1) Modes: maxima of the density of the normals, found by mean shift. A mode counts when its normals outweigh those
///     of the ring around it (between one and two tolerances), scaled to the same area, `min_contrast` times, by
///     `min_support` and by `min_significance`: isotropic clutter, such as foliage, has as many there.
/// (2) Pairs and triads of modes whose nearest orthonormal axes (Procrustes, weights sqrt(support)) are within
///     `max_offset_rad` plus the spread of the mode: a sensor that scatters normals by 5° bends surfaces by as much.
/// (3) A pair or triad among the m strongest modes must be better than chance. Of modes with random directions,
///     C(m, 2) · s pairs and C(m, 3) · 2/π · s³ triads have all |cosines| <= s. One direction needs no such proof.
/// (4) Of what is left, the largest sum of square roots of the support above the background. The square root keeps a
///     large floor from starving the third direction: a triad with a weak third member wins over a stronger pair.
///
/// @param normals  N unit vectors; n and −n are the same.
/// @param weights  N positive numbers, or none: all 1.
/// @return         Bit-identical for every order and all signs of the normals.
/// @throws InvalidArgument  if `settings` is out of range, a normal is not of unit length within 1e-6, a weight is not
///                          positive and finite, or the numbers of normals and weights differ. No direction is a
///                          result.
///
/// Cost: O(N) for N > 1500, O(N²) below; 50 ms for 10,000 normals.
OrthogonalTriad orthogonal_triad(PointsView normals, const OrthogonalTriadSettings& settings = {},
                                 std::span<const double> weights = {});

}  // namespace trysquare
