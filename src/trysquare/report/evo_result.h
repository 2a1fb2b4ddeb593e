// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/trajectory/ape.h"
#include "trysquare/trajectory/error_series.h"
#include "trysquare/trajectory/rpe.h"

#include <cstddef>
#include <string>
#include <vector>

namespace trysquare {

/// The parts of a result file of evo, which evo_res opens: info.json, stats.json, and a .npy for each array.
struct EvoResult {
  struct Array {
    std::string name;  ///< "error_array", ...
    std::vector<double> values;
    std::size_t num_columns = 0;  ///< 0: a vector.
  };
  std::string info_json{};
  std::string stats_json{};
  std::vector<Array> arrays{};
};

/// Under the names, titles and labels of evo 1.36.
/// @param reference_name, estimate_name  What evo shows: the paths, usually.
/// REQUIRES: errors that are not empty.
EvoResult evo_result(const TrajectoryErrors& errors, const ApeSettings& settings, const ErrorSeries& series,
                     const std::string& reference_name, const std::string& estimate_name);
EvoResult evo_result(const TrajectoryErrors& errors, const RpeSettings& settings, const ErrorSeries& series,
                     const std::string& reference_name, const std::string& estimate_name);

/// One line per error: the poses that it belongs to (of APE, twice the same), when and where it happened, and how large
/// it is. Without time stamps that column is empty.
std::string errors_csv(const TrajectoryErrors& errors, const ErrorSeries& series);

}  // namespace trysquare
