// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/definition.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// MOM or OMME: one value, what every direction says, and both ways of putting the directions together.
struct OrthogonalMetricResult {
  struct Direction {
    Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();
    std::size_t num_points = 0;      ///< Query points of the direction.
    std::size_t num_used = 0;        ///< Those that are defined.
    std::size_t num_degenerate = 0;  ///< Exactly planar neighborhoods.
    std::size_t num_too_few = 0;
    std::optional<double> mean;  ///< Empty when no point of the direction is defined.
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

/// Steps 2 and 3 of MOM and OMME: puts the directions together, in both flavours.
/// @param directions  Each with its mean and median.
/// @param definition  Which of the two flavours is `value`.
OrthogonalMetricResult combine_directions(std::vector<OrthogonalMetricResult::Direction> directions,
                                          Definition definition);

}  // namespace trysquare
