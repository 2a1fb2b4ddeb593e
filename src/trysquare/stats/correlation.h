// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

namespace trysquare {

/// Three coefficients of how well y follows x, all in [−1, 1]: 1 follows, 0 unrelated, −1 runs against.
///
/// @param x, y  Equally many finite values; x[i] belongs to y[i].
/// @return      nullopt when it is not defined: fewer than two values, or one side does not vary.
/// @throws InvalidArgument  if the sizes differ or a value is not finite.

/// Pearson's r: how near the points are to a straight line. Two passes, scaled: values of any magnitude.
std::optional<double> pearson(std::span<const double> x, std::span<const double> y);

/// Spearman's ρ: Pearson's r of the ranks; equal values share their average rank.
std::optional<double> spearman(std::span<const double> x, std::span<const double> y);

/// Kendall's τ-b: concordant minus discordant pairs, over the geometric mean of the pairs not tied in x and in y.
/// Source:  Knight, A computer method for calculating Kendall's tau with ungrouped data, 1966. O(n log n).
std::optional<double> kendall_tau_b(std::span<const double> x, std::span<const double> y);

}  // namespace trysquare
