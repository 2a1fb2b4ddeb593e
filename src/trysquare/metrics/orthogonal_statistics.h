// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/orthogonal_subset.h"
#include "trysquare/metrics/point_statistics.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
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

/// MOM or OMME: one value, what every direction says, and both ways of putting the directions together.
struct OrthogonalMetricResult {
  struct Direction {
    Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();
    std::size_t num_points = 0;      ///< Query points of the direction.
    std::size_t num_used = 0;        ///< Those that are defined.
    std::size_t num_degenerate = 0;  ///< Exactly planar neighborhoods.
    std::size_t num_too_few = 0;
    std::optional<double> mean;      ///< Empty when no point of the direction is defined.
    std::optional<double> median;
  };

  std::optional<double> value;           ///< By the chosen definition; empty when no direction is defined, never 0.
  std::string reason;                    ///< Why `value` is empty; empty otherwise.
  std::optional<double> mean_of_means;   ///< The paper's: average over the directions of the mean of each.
  std::optional<double> sum_of_medians;  ///< map-metrics': sum over the directions of the median of each.
  std::vector<Direction> directions;

  /// False in the degenerate case (fewer than three defined directions): still comparable between runs on one scene,
  /// but not expected to follow RPE. Paper §IV-C.
  bool follows_trajectory_error = false;
};

}  // namespace trysquare
