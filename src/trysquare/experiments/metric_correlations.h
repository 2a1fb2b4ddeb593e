// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/experiments/metric_study.h"
#include "trysquare/stats/correlation_interval.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trysquare {

/// The coefficients in the order in which every table has them.
inline constexpr std::array<Coefficient, 3> kCoefficients = {Coefficient::kPearson, Coefficient::kSpearman,
                                                             Coefficient::kKendallTauB};

/// How intervals are computed.
enum class IntervalMethod { kBootstrap, kFisher };

/// "bootstrap", "fisher".
constexpr std::string_view name_of(IntervalMethod method) {
  return method == IntervalMethod::kBootstrap ? "bootstrap" : "fisher";
}

/// A coefficient and where the true one may be; empty when it is undefined.
struct CoefficientEstimate {
  std::optional<double> value;
  std::optional<Interval> interval;
};

/// How well one metric follows the paper's RPE over the trajectories of one study.
struct MetricCorrelation {
  std::string metric;
  std::size_t num_trajectories = 0;
  std::size_t num_defined = 0;                      ///< Trajectories for which the metric has a value: the pairs.
  std::array<CoefficientEstimate, 3> coefficients;  ///< In the order of kCoefficients.
};

/// The correlation of each metric of the table with "paper_rpe".
/// @param bootstrap  Confidence of either method; the others are of the bootstrap.
/// @throws InvalidArgument  if the table has no such column, or `bootstrap` is out of range.
std::vector<MetricCorrelation> correlations_with_rpe(const MetricSamples& samples, IntervalMethod method,
                                                     const BootstrapSettings& bootstrap = {});

/// A coefficient over the environments of a group.
struct CoefficientSummary {
  std::size_t num_defined = 0;            ///< Environments in which the coefficient has a value.
  std::optional<double> mean;             ///< Empty when there is none.
  std::optional<double> std;              ///< Of the sample (divisor n − 1); empty for fewer than two.
  std::optional<Interval> mean_interval;  ///< Of the mean, between environments; bootstrap. Empty as std.
  std::optional<double> min;
  std::optional<double> max;
};

/// One metric over environments.
struct MetricSummary {
  std::string metric;
  std::size_t num_environments = 0;
  std::array<CoefficientSummary, 3> coefficients;  ///< In the order of kCoefficients.
};

/// Sums up what several environments of one kind say.
/// @param environments  Each with the same metrics in the same order.
/// @throws InvalidArgument  if they differ, or `bootstrap` is out of range.
std::vector<MetricSummary> summary_over_environments(std::span<const std::vector<MetricCorrelation>> environments,
                                                     const BootstrapSettings& bootstrap = {});

}  // namespace trysquare
