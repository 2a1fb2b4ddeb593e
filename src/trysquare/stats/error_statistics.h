// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace trysquare {

/// The seven numbers that evo prints about a list of errors, in the unit of the errors (sse: squared).
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0;
  double mean = 0;
  double median = 0;
  double std = 0;  ///< Population standard deviation (divisor n), as numpy's default and evo's.
  double min = 0;
  double max = 0;
  double sse = 0;  ///< Sum of squared errors.
};

/// @param errors  At least one value, none NaN.
/// @throws InvalidArgument  if `errors` is empty: statistics of nothing are undefined, not 0.
ErrorStatistics error_statistics(std::span<const double> errors);

}  // namespace trysquare
