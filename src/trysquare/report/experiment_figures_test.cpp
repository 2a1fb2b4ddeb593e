// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/experiment_figures.h"

#include "trysquare/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace trysquare {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<MetricCorrelation> mom_with(double pearson) {
  MetricCorrelation mom{.metric = "mom_sum_of_medians_paper"};
  mom.coefficients[0].value = pearson;
  return {mom};
}

TEST(CorrelationsFigure, HasAPanelForEveryGroupAndAMarkForEveryLength) {
  const std::vector<ExperimentUnit> units = {{"a", 0, 5, 0}, {"a", 1, 5, 0}, {"a", 0, 15, 0}, {"b", 0, 5, 0.01}};
  const std::vector<std::vector<MetricCorrelation>> correlations = {mom_with(0.5), mom_with(0.7), mom_with(0.9),
                                                                    mom_with(-0.5)};
  const Figure figure = correlations_figure(units, correlations);
  EXPECT_EQ(figure.file_name, "correlations.svg");
  for (const char* text : {"Pearson: a", "Kendall: a", "Pearson: b, 0.573° rotation noise", "15 poses", ">MOM<",
                           ">med.<", ">paper<", "mean 0.600 of 2 environments", "mean 0.900 of 1 environments"}) {
    EXPECT_THAT(figure.svg, HasSubstr(text));
  }
}

TEST(CorrelationsFigure, RefusesNothing) {
  EXPECT_THROW(correlations_figure({}, {}), InvalidArgument);
  EXPECT_THROW(correlations_figure(std::vector<ExperimentUnit>(1), {}), InvalidArgument);
}

TEST(ScatterFigure, SaysHowWellTheDotsFollow) {
  const MetricSamples samples{{"paper_rpe", "mme", "mpv", "omme", "mom"},
                              {{1, -3, 0.001, 5, 1}, {2, -2, 0.002, 4, 1}, {3, -2, 0.003, 4, 1}}};
  const Figure figure = scatter_figure(std::vector<ScatterRow>{{"three", samples}});
  EXPECT_THAT(figure.svg, HasSubstr("MPV [10⁻³ m²], Pearson 1.000"));
  EXPECT_THAT(figure.svg, HasSubstr("MOM [m²], undefined"));
  EXPECT_THAT(figure.svg, Not(HasSubstr("nan")));
}

TEST(ScatterFigure, LeavesOutWhatIsUndefined) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const MetricSamples samples{{"paper_rpe", "mme", "mpv", "omme", "mom"},
                              {{1, nan, 1, nan, 1}, {2, nan, 2, 4, nan}, {3, nan, 4, 5, 1}}};
  const Figure figure = scatter_figure(std::vector<ScatterRow>{{"holes", samples}});
  EXPECT_THAT(figure.svg, HasSubstr("MME [nats], undefined"));
  EXPECT_THAT(figure.svg, HasSubstr("OMME [nats], Pearson 1.000"));
  EXPECT_THAT(figure.svg, Not(HasSubstr("nan,")));
  EXPECT_THROW(scatter_figure({}), InvalidArgument);
  EXPECT_THROW(scatter_figure(std::vector<ScatterRow>(1)), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
