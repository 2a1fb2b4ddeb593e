// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/orthogonal_subset.h"
#include "trysquare/metrics/point_statistics.h"
#include "trysquare/neighborhood/stream_neighborhoods.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace trysquare {

/// The statistics of the points of an orthogonal subset, direction by direction: what MOM and OMME summarise.
struct OrthogonalStatistics {
  struct Direction {
    Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();
    PointStatistics points;
  };
  std::vector<Direction> directions;  ///< In the order of the subset.
};

/// @param map       Index over the registered map: N points, map frame [m].
/// @param subset    Query points by direction, same frame; see extract_orthogonal_subset().
/// @param settings  Neighborhood W(p); the paper's code uses 4 as the least number of neighbors here.
/// @throws InvalidArgument  if `settings` is out of range.
OrthogonalStatistics orthogonal_statistics(const PointIndex& map, const OrthogonalSubset& subset,
                                           const NeighborhoodSettings& settings, const Execution& execution = {});

/// The same from scans that stream by, without map and index: the fast way when MOM or OMME is all that is asked for.
/// @param num_scans, points_of_scan  The map, scan by scan; see stream_neighborhoods().
OrthogonalStatistics orthogonal_statistics(std::size_t num_scans, const PointsOfScan& points_of_scan,
                                           const OrthogonalSubset& subset, const NeighborhoodSettings& settings,
                                           const Execution& execution = {});

}  // namespace trysquare
