// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/stats/interval.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace trysquare {

/// Which of the coefficients of correlation.h.
enum class Coefficient { kPearson, kSpearman, kKendallTauB };

/// "pearson", "spearman", "kendall".
std::string_view name_of(Coefficient coefficient);

/// The coefficient of x and y; see correlation.h for what is undefined and what throws.
std::optional<double> correlation(Coefficient coefficient, std::span<const double> x, std::span<const double> y);

/// Fisher's interval: the coefficient's inverse hyperbolic tangent is taken for normal. No pairs needed, only their
/// number. Right for pairs of normal numbers; a bootstrap supposes less.
///
/// @param value       Of the coefficient, in [−1, 1].
/// @param num_pairs   That `value` was computed from.
/// @param confidence  In (0, 1), 0.95 for instance.
/// @return            nullopt for fewer than 4 pairs (Kendall: 5). Of no width at ±1.
/// @throws InvalidArgument  if `value` or `confidence` is out of range.
///
/// Source: Fisher 1915 (Pearson: 1/(n − 3)); Bonett & Wright, Sample size requirements, 2000 (Spearman:
///         (1 + ρ²/2)/(n − 3)); Fieller, Hartley & Pearson 1957 (Kendall: 0.437/(n − 4)).
std::optional<Interval> fisher_interval(Coefficient coefficient, double value, std::size_t num_pairs,
                                        double confidence = 0.95);

/// How often and with which seed a bootstrap draws.
struct BootstrapSettings {
  std::size_t num_resamples = 1000;  ///< >= 20
  double confidence = 0.95;          ///< In (0, 1).
  std::uint64_t seed = 0;

  void validate() const;  ///< @throws InvalidArgument
};

/// Percentile bootstrap: the coefficient of pairs drawn with replacement, again and again; the middle `confidence` of
/// what comes out. Resamples whose coefficient is undefined are left out.
///
/// @return  nullopt when the coefficient of the pairs themselves is undefined. Same on every platform.
/// @throws InvalidArgument  as correlation(), and if `settings` is out of range.
///
/// Source: Efron & Tibshirani, An Introduction to the Bootstrap, 1993, §13.3.
std::optional<Interval> bootstrap_interval(Coefficient coefficient, std::span<const double> x,
                                           std::span<const double> y, const BootstrapSettings& settings = {});

/// The same of a mean: of `values`, all finite. nullopt for fewer than two.
std::optional<Interval> bootstrap_interval_of_mean(std::span<const double> values,
                                                   const BootstrapSettings& settings = {});

}  // namespace trysquare
