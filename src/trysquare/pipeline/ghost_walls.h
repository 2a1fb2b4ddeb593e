// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/patch_observations.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trysquare {

/// One flat surface that the map shows twice: some scans put it here, the others there.
struct GhostWall {
  Eigen::Vector3d center_in_map = Eigen::Vector3d::Zero();  ///< Mean of its patches [m].
  Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();  ///< Unit, from the lower to the upper scans' surface.
  double distance_m = 0;                                    ///< Between the two surfaces: median over its patches.
  double limit_m = 0;                                       ///< Least distance that is told from noise: likewise.
  double noise_m = 0;                                       ///< Spread within each of them: likewise.
  double extent_m = 0;                                      ///< Of its patches' centers, from the farthest to another.
  std::size_t num_patches = 0;
  std::vector<std::uint32_t> lower_scans;  ///< Scans that see the one surface, ascending ...
  std::vector<std::uint32_t> upper_scans;  ///< ... and those that see the other.
  std::optional<double> adjusted_m;        ///< The same distance at the adjusted poses; empty: there are none.
};

/// A ghost wall whose distance falls below this share at the adjusted poses comes from the poses; else the scene itself
/// changed.
inline constexpr double kShareThatPosesExplain = 0.5;

/// Seeks surfaces on which the scans fall into two groups.
///
/// Per patch the intercepts are split in two where that leaves the least variance. The two are apart when their
/// distance is at least 5 cm, 4 standard deviations within the groups and 2.5 times the noise of points within a scan,
/// the gap between them is at least half of it, and each holds three scans. (Where some scans see a second surface in
/// the patch, as at the foot of a wall, their points spread by more than their mean moves: the noise rule.) Such
/// patches of one plane, parallel to 10 degrees and within 4 m of each other, make a wall: three at least, half at
/// least of those there that both groups see, and agreeing on who sees which surface. Independent errors of few poses
/// look like two groups now and then: so the groups must also change at most once in five scans along the sequence, or
/// be apart by 8 standard deviations.
///
/// @param given     Patches as seen from the given poses.
/// @param adjusted  The same patches, in the same order, as seen from the adjusted poses; empty: there are none.
/// @return          Most patches first.
/// Source: docs/definitions.md#diagnosis.
std::vector<GhostWall> find_ghost_walls(std::span<const ObservedPatch> given, std::span<const ObservedPatch> adjusted);

}  // namespace trysquare
