// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/error_statistics.h"

#include "trysquare/core/error.h"
#include "trysquare/stats/median.h"

#include <algorithm>
#include <cmath>

namespace trysquare {

ErrorStatistics error_statistics(std::span<const double> errors) {
  if (errors.empty()) throw InvalidArgument("errors is empty: statistics need at least one value");
  const double n = static_cast<double>(errors.size());
  ErrorStatistics result{.count = errors.size(), .min = errors.front(), .max = errors.front()};
  double sum = 0;
  for (const double error : errors) {
    sum += error;
    result.sse += error * error;
    result.min = std::min(result.min, error);
    result.max = std::max(result.max, error);
  }
  result.mean = sum / n;
  result.rmse = std::sqrt(result.sse / n);
  result.median = *median_of_defined(errors);
  double squared_deviations = 0;
  for (const double error : errors) squared_deviations += (error - result.mean) * (error - result.mean);
  result.std = std::sqrt(squared_deviations / n);
  return result;
}

}  // namespace trysquare
