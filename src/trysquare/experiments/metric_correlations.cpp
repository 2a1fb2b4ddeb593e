// SPDX-License-Identifier: Apache-2.0
#include "trysquare/experiments/metric_correlations.h"

#include "trysquare/core/error.h"

#include <algorithm>
#include <cmath>

namespace trysquare {
namespace {

std::optional<Interval> interval_of(Coefficient coefficient, double value, std::span<const double> x,
                                    std::span<const double> y, IntervalMethod method,
                                    const BootstrapSettings& bootstrap) {
  if (method == IntervalMethod::kFisher) return fisher_interval(coefficient, value, x.size(), bootstrap.confidence);
  return bootstrap_interval(coefficient, x, y, bootstrap);
}

MetricCorrelation correlation_of(const std::string& metric, std::span<const double> values,
                                 std::span<const double> rpe_m2, IntervalMethod method,
                                 const BootstrapSettings& bootstrap) {
  std::vector<double> defined;
  std::vector<double> rpe_of_defined;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    defined.push_back(values[i]);
    rpe_of_defined.push_back(rpe_m2[i]);
  }
  MetricCorrelation result{
      .metric = metric, .num_trajectories = values.size(), .num_defined = defined.size(), .coefficients = {}};
  for (std::size_t c = 0; c < kCoefficients.size(); ++c) {
    CoefficientEstimate& estimate = result.coefficients.at(c);
    estimate.value = correlation(kCoefficients.at(c), defined, rpe_of_defined);
    if (!estimate.value) continue;
    estimate.interval = interval_of(kCoefficients.at(c), *estimate.value, defined, rpe_of_defined, method, bootstrap);
  }
  return result;
}

CoefficientSummary summary_of(const std::vector<double>& values, const BootstrapSettings& bootstrap) {
  CoefficientSummary summary{.num_defined = values.size()};
  if (values.empty()) return summary;
  const auto n = static_cast<double>(values.size());
  double sum = 0;
  for (const double value : values) sum += value;
  const double mean = sum / n;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  summary.mean = mean;
  summary.min = *std::min_element(values.begin(), values.end());
  summary.max = *std::max_element(values.begin(), values.end());
  if (values.size() < 2) return summary;
  summary.std = std::sqrt(squares / (n - 1));
  summary.mean_interval = bootstrap_interval_of_mean(values, bootstrap);
  return summary;
}

}  // namespace

std::vector<MetricCorrelation> correlations_with_rpe(const MetricSamples& samples, IntervalMethod method,
                                                     const BootstrapSettings& bootstrap) {
  bootstrap.validate();
  const std::vector<double> rpe_m2 = samples.column("paper_rpe");
  std::vector<MetricCorrelation> result;
  for (const std::string& metric : metric_columns(samples.columns)) {
    result.push_back(correlation_of(metric, samples.column(metric), rpe_m2, method, bootstrap));
  }
  return result;
}

std::vector<MetricSummary> summary_over_environments(std::span<const std::vector<MetricCorrelation>> environments,
                                                     const BootstrapSettings& bootstrap) {
  bootstrap.validate();
  std::vector<MetricSummary> result;
  if (environments.empty()) return result;
  for (std::size_t m = 0; m < environments.front().size(); ++m) {
    MetricSummary summary{
        .metric = environments.front()[m].metric, .num_environments = environments.size(), .coefficients = {}};
    for (std::size_t c = 0; c < kCoefficients.size(); ++c) {
      std::vector<double> values;
      for (const std::vector<MetricCorrelation>& environment : environments) {
        if (m >= environment.size() || environment[m].metric != summary.metric) {
          throw InvalidArgument("the environments have different metrics");
        }
        if (environment[m].coefficients.at(c).value) values.push_back(*environment[m].coefficients.at(c).value);
      }
      summary.coefficients.at(c) = summary_of(values, bootstrap);
    }
    result.push_back(std::move(summary));
  }
  return result;
}

}  // namespace trysquare
