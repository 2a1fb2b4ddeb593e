// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"

#include <cstdint>
#include <vector>

namespace trysquare {

/// How far apart two clusters are.
enum class Linkage {
  kComplete,  ///< As far as their farthest members.
  kWard,      ///< √(2ab / (a + b)) · |A − B| for a and b members with the centroids A and B.
};

/// How normals are clustered.
struct NormalClusterSettings {
  Linkage linkage = Linkage::kComplete;
  double cut = 0.1;       ///< Clusters merge while their distance is below; > 0 and finite.
  bool sign_free = true;  ///< n and −n are one: their distance to m is min(|n − m|, |n + m|). Not for Ward.

  /// @throws InvalidArgument  also for Ward with sign_free: the centroid of normals without signs is not defined.
  void validate() const;
};

/// Agglomerative clustering of unit normals: the nearest two clusters merge, again and again, while their distance is
/// below the cut.
///
/// Exact: the partition of the definition, for complete linkage to the last bit. Of pairs at the same distance those
/// merge first whose clusters come first; a cluster stands where its first member does when normals are sorted by x, y,
/// z (sign-free: of n and −n that one whose first coordinate that is not zero is positive).
///
/// @param normals   N unit vectors.
/// @param settings  See there.
/// @return          N labels 0, 1, 2, ... in order of first appearance; equal labels are one cluster.
/// @throws InvalidArgument  if `settings` is out of range, or a normal is not finite or not of length 1 up to 1e-6.
///
/// Properties (normal_clusters_test.cpp):
///   (1) permuting normals permutes the partition, exact ties or not   (2) sign-free: so do flips of signs
///
/// Source:  paper §IV-B (complete linkage; its code takes Ward on signed normals).
/// Differs: docs/definitions.md#21-linkage.
/// Cost:    about 230 bytes a normal. Time grows little faster than N: the 60 203 planar normals of a KITTI scan take
///          0.4 s, 200 000 spread over the whole sphere 1.3 s. No input is known to take O(N²), but none is ruled out.
std::vector<std::uint32_t> cluster_normals(PointsView normals, const NormalClusterSettings& settings = {});

}  // namespace trysquare
