// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trysquare {

/// Agglomerative clustering of unit normals with complete linkage, cut at a distance.
///
/// Normals carry no sign: the distance of n and m is min(|n − m|, |n + m|). Two clusters are as far apart as their
/// farthest members, and merge while that is below `cut`, nearest first.
///
/// @param normals  N unit vectors.
/// @param cut      In (0, √2].
/// @return         N labels 0, 1, 2, ... in order of first appearance; equal labels are one cluster.
///
/// Source: paper §IV-B (complete linkage; its code takes Ward). Nearest-neighbor chain: Murtagh 1983.
/// Cost:   O(N²) time, 4·N² bytes.
std::vector<std::uint32_t> cluster_normals(PointsView normals, double cut);

}  // namespace trysquare
