// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/points.h"
#include "trysquare/neighborhood/for_each_neighborhood.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <vector>

namespace trysquare {

/// Gives the points of one scan of a map, in the map frame [m]. Called from several threads, and may be called twice
/// for a scan.
using PointsOfScan = std::function<std::vector<Eigen::Vector3d>(std::size_t scan)>;

/// for_each_neighborhood() for few queries in a map that is never held: the scans stream by, each adds what it has near
/// the queries, and neither the map nor an index of it takes memory. MOM asks for neighborhoods like this.
///
/// @param num_scans       Scans of the map. Moments::num_scans counts those that have points near the query.
/// @param queries_in_map  M points, map frame [m].
/// @throws InvalidArgument  as for_each_neighborhood(), for queries and points of scans.
/// What `points_of_scan` throws reaches the caller.
///
/// Accuracy: as for_each_neighborhood(). Cost: every point is looked at; a fast scan has neighbors follow each other,
/// as along the rings of a LiDAR or the rows of a depth image. Memory: 80 bytes a query for each of
/// 16 scans, and one scan a thread; and the neighbors themselves of queries in clusters so small and far from others
/// that their sums would lose digits.
void stream_neighborhoods(std::size_t num_scans, const PointsOfScan& points_of_scan, PointsView queries_in_map,
                          const NeighborhoodSettings& settings, const Execution& execution,
                          const std::function<void(const NeighborhoodBlock&)>& visit);

}  // namespace trysquare
