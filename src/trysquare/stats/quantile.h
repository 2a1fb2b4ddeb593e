// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace trysquare {

/// The value below which the share `q` of the values lies, linear between the two nearest ranks: numpy's default.
/// @param sorted  Ascending, at least one, none NaN.
/// @param q       In [0, 1]; 0 is the smallest, 1 the largest value.
/// @throws InvalidArgument  if `sorted` is empty or q is out of range.
double quantile_of_sorted(std::span<const double> sorted, double q);

}  // namespace trysquare
