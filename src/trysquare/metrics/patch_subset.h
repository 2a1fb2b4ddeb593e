// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/registered_map.h"
#include "trysquare/metrics/orthogonal_subset.h"
#include "trysquare/metrics/orthogonal_triad.h"
#include "trysquare/metrics/planar_patches.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// How an orthogonal subset is made from planar patches.
struct PatchSubsetSettings {
  PlanarPatchSettings patches;
  OrthogonalTriadSettings triad;
  double planarity_ratio = 100;  ///< Of a point's neighborhood of radius_m in its scan: ratio · λ₁ < λ₂; > 0.
  std::size_t min_points = 12;   ///< A direction keeps its flattest ones when fewer have such a neighborhood; >= 1.

  void validate() const;  ///< @throws InvalidArgument
};

/// An orthogonal subset and what it was made from.
struct PatchSubsetResult {
  OrthogonalSubset subset;  ///< 0 to 3 directions, most support first: centers of patches, normal = axis.
  std::string reason;       ///< Why there are fewer than three; empty otherwise.
  std::vector<TriadDirection> directions;  ///< How well each direction of the subset is supported.
  double chance = 0;                       ///< Expected number of triads, or pairs, like this one by chance.
  std::size_t num_candidates = 0;          ///< Points looked at.
  std::size_t num_planar = 0;              ///< Of these, on a planar patch.
  std::size_t num_patches = 0;  ///< Of these, the flattest of their voxel: what the directions are made from.
  std::size_t num_modes = 0;    ///< Directions that stand out, orthogonal to another or not.

  /// num_planar / num_candidates; nullopt when there were no candidates.
  std::optional<double> planar_share() const;
};

/// Finds up to three mutually orthogonal directions and points of scans on flat surfaces that face them, from planar
/// patches (planar_patches.h) and their normals (orthogonal_triad.h).
///
/// Patches are smaller than the neighborhoods of the metrics. Of those that face a direction, the points are those that
/// a scan sees in a flat neighborhood of radius_m, too: plane variance measures pose errors only where the scan itself
/// is flat, and near the edge of a wall it is not.
///
/// Works on one scan, several scans, or a map. On KITTI 00 the axes move by 0.1° at most from one map of five scans to
/// the next, and by 0.2° from one scan to the next.
///
/// @param map        N points in scan order, map frame [m].
/// @param radius_m   The radius of the metrics' neighborhoods, > 0 [m]; lengths in the settings are multiples of it.
/// @param execution  Threads. The result is bit-identical for every value, and for every order of the points of a scan.
/// @return           Fewer than three directions are a result, not an error: `reason` says why.
/// @throws InvalidArgument  as planar_patches() and orthogonal_triad() do.
///
/// Differs: paper §IV-B and its code cluster the normals of one scan; a cluster of six points can win there, and the
///          axes jump by up to 38° between neighboring scans.
/// Cost:    five scans of 120,000 points take about 0.4 s on one core.
PatchSubsetResult patch_subset(const RegisteredMap& map, double radius_m, const PatchSubsetSettings& settings = {},
                               const Execution& execution = {});

}  // namespace trysquare
