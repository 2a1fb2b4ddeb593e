// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace trysquare {

/// One cluster of normals as the search for directions sees it.
struct NormalCluster {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< Unit length, sign arbitrary.
  std::size_t num_points = 0;
};

/// The mutually orthogonal clusters with the most points: the maximum clique of the graph that joins orthogonal ones.
/// Triads come before pairs and pairs before single clusters; four mutually orthogonal clusters cannot exist.
///
/// @param orthogonality_bound  n and m are orthogonal when |n·m| < bound; in (0, 1/3).
/// @return                     0 to 3 indices into `clusters`, most points first; normals decide ties, not the
///                             order of the clusters.
/// Source: paper §IV-B. Cost: O(K³) for K clusters, less where few pairs are orthogonal.
std::vector<std::size_t> largest_orthogonal_clique(std::span<const NormalCluster> clusters, double orthogonality_bound);

}  // namespace trysquare
