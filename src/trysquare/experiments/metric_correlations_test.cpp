// SPDX-License-Identifier: Apache-2.0
#include "trysquare/experiments/metric_correlations.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trysquare {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// mpv follows, mme runs against it, omme is undefined somewhere, mom never changes.
const MetricSamples kSamples{{"paper_rpe", "rpe", "mme", "mpv", "omme", "mom"},
                             {{1, 1, -1, 10, 4, 7},
                              {2, 1.4, -4, 20, kNaN, 7},
                              {3, 1.7, -9, 30, 5, 7},
                              {4, 2, -16, 40, 4.5, 7},
                              {5, 2.2, -25, 50, 6, 7}}};

TEST(CorrelationsWithRpe, AreThoseOfEveryMetric) {
  const std::vector<MetricCorrelation> all = correlations_with_rpe(kSamples, IntervalMethod::kFisher);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].metric, "mme");
  EXPECT_DOUBLE_EQ(*all[0].coefficients[1].value, -1);
  EXPECT_GT(*all[0].coefficients[0].value, -1);
  EXPECT_DOUBLE_EQ(*all[1].coefficients[0].value, 1);
  EXPECT_DOUBLE_EQ(*all[1].coefficients[2].value, 1);
}

TEST(CorrelationsWithRpe, LeaveOutWhatIsUndefinedAndCountIt) {
  const std::vector<MetricCorrelation> all = correlations_with_rpe(kSamples, IntervalMethod::kFisher);
  EXPECT_EQ(all[2].num_trajectories, 5u);
  EXPECT_EQ(all[2].num_defined, 4u);
  EXPECT_DOUBLE_EQ(*all[2].coefficients[2].value, 4.0 / 6);  // of six pairs of (1 3 4 5), (4 5 4.5 6) one runs against
  EXPECT_EQ(all[3].coefficients[0].value, std::nullopt);     // does not vary
  EXPECT_EQ(all[3].coefficients[0].interval, std::nullopt);
}

TEST(CorrelationsWithRpe, HaveIntervalsByEitherMethod) {
  for (const IntervalMethod method : {IntervalMethod::kBootstrap, IntervalMethod::kFisher}) {
    const std::vector<MetricCorrelation> all = correlations_with_rpe(kSamples, method, {.num_resamples = 50});
    const CoefficientEstimate& pearson = all[2].coefficients[0];
    ASSERT_TRUE(pearson.interval) << name_of(method);
    EXPECT_LE(pearson.interval->low, *pearson.value);
    EXPECT_GE(pearson.interval->high, *pearson.value);
  }
}

MetricCorrelation pearson_of(std::optional<double> value) {
  MetricCorrelation correlation{.metric = "mom"};
  correlation.coefficients[0].value = value;
  return correlation;
}

TEST(SummaryOverEnvironments, IsWorkedByHand) {
  const std::vector<std::vector<MetricCorrelation>> environments = {
      {pearson_of(0.2)}, {pearson_of(0.4)}, {pearson_of(std::nullopt)}, {pearson_of(0.9)}};
  const std::vector<MetricSummary> summary = summary_over_environments(environments);
  ASSERT_EQ(summary.size(), 1u);
  EXPECT_EQ(summary[0].num_environments, 4u);
  const CoefficientSummary& pearson = summary[0].coefficients[0];
  EXPECT_EQ(pearson.num_defined, 3u);
  EXPECT_DOUBLE_EQ(*pearson.mean, 0.5);
  EXPECT_NEAR(*pearson.std, std::sqrt((0.09 + 0.01 + 0.16) / 2), 1e-15);
  EXPECT_EQ(pearson.min, 0.2);
  EXPECT_EQ(pearson.max, 0.9);
  EXPECT_GE(pearson.mean_interval->low, 0.2);
  EXPECT_LE(pearson.mean_interval->high, 0.9);
  EXPECT_EQ(summary[0].coefficients[1].mean, std::nullopt);
}

using Environments = std::vector<std::vector<MetricCorrelation>>;

TEST(SummaryOverEnvironments, HasNoSpreadOfOne) {
  const std::vector<MetricSummary> summary = summary_over_environments(Environments{{pearson_of(0.2)}});
  EXPECT_EQ(summary[0].coefficients[0].mean, 0.2);
  EXPECT_EQ(summary[0].coefficients[0].std, std::nullopt);
  EXPECT_EQ(summary[0].coefficients[0].mean_interval, std::nullopt);
}

TEST(SummaryOverEnvironments, RefusesDifferentMetrics) {
  MetricCorrelation other = pearson_of(0.2);
  other.metric = "mpv";
  EXPECT_THROW(summary_over_environments(Environments{{pearson_of(0.2)}, {other}}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
