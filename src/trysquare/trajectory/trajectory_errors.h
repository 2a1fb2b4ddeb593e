// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/stats/error_statistics.h"
#include "trysquare/trajectory/alignment.h"
#include "trysquare/trajectory/pose_pairs.h"
#include "trysquare/trajectory/pose_relation.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace trysquare {

/// What APE and RPE return: one error per pose or pair, their statistics, and how they came about.
struct TrajectoryErrors {
  std::vector<double> errors{};          ///< APE: per pose. RPE: per pair. In `unit`.
  ErrorStatistics statistics{};          ///< Of `errors`.
  std::vector<PosePair> pairs{};         ///< RPE: the two poses of each error. APE: empty.
  PoseRelation relation{};               ///< As in the settings.
  std::string_view unit{};               ///< unit_of(relation), unless change_unit() changed it.
  std::size_t num_zero_distances = 0;    ///< kPointDistanceErrorRatio: pairs without a distance, which have no ratio.
  Similarity reference_from_estimate{};  ///< What the estimate was aligned with; identity without alignment.
};

}  // namespace trysquare
