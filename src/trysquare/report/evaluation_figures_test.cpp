// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/evaluation_figures.h"

#include "trysquare/core/error.h"
#include "trysquare/report/internal/charts_test_example.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace trysquare {
namespace {

using internal::Json;

std::vector<std::string> names_of(const std::vector<Figure>& figures) {
  std::vector<std::string> names;
  for (const Figure& figure : figures) names.push_back(figure.file_name);
  return names;
}

TEST(Figures, AreAHeatMapPerDefinedMetricAndTheWindows) {
  EXPECT_THAT(names_of(figures(internal::example_evaluation().dump())),
              testing::ElementsAre("heatmap_mom.svg", "heatmap_mpv.svg", "heatmap_mme.svg", "heatmap_overlap.svg",
                                   "windows.svg"));
}

TEST(Figures, AreWellFormedEvenWithHostileReasons) {
  Json evaluation = internal::example_evaluation();
  evaluation["windows"][2]["mom_reason"] = "</title><script>\"&'\x01";
  for (const Figure& figure : figures(evaluation.dump())) {
    EXPECT_EQ(internal::xml_fault(figure.svg), "") << figure.file_name;
    EXPECT_EQ(figure.svg.find("<script"), std::string::npos) << figure.file_name;
    EXPECT_EQ(figure.svg.find('\x01'), std::string::npos) << figure.file_name;
  }
}

TEST(Figures, LoadNothing) {
  for (const Figure& figure : figures(internal::example_evaluation().dump())) {
    EXPECT_EQ(internal::occurrences(figure.svg, "http"), 1U) << "only the name of the SVG namespace";
    for (const char* const load : {"url(", "href", "@import", "src="}) {
      EXPECT_EQ(figure.svg.find(load), std::string::npos) << figure.file_name << ": " << load;
    }
  }
}

TEST(Figures, DoNotExistWithoutWindows) {
  Json evaluation = internal::example_evaluation();
  evaluation["windows"] = Json::array();
  EXPECT_TRUE(figures(evaluation.dump()).empty());
}

TEST(Figures, OfAMapWithoutTrajectoryAreTheWindowsAlone) {
  Json evaluation = internal::example_evaluation();
  evaluation["trajectory"] = nullptr;
  EXPECT_THAT(names_of(figures(evaluation.dump())), testing::ElementsAre("windows.svg"));
}

TEST(Figures, OfAnythingButAnEvaluationAreRefused) {
  EXPECT_THROW(figures("{"), InvalidArgument);
  EXPECT_THROW(figures(R"({"schema": "trysquare.orthogonal/1"})"), InvalidArgument);
  EXPECT_THROW(figures(R"({"schema": "trysquare.evaluation/1"})"), InvalidArgument);
  Json evaluation = internal::example_evaluation();
  evaluation["windows"][1]["mom"] = "much";
  EXPECT_THROW(figures(evaluation.dump()), InvalidArgument);
  evaluation = internal::example_evaluation();
  evaluation["windows"][1]["last"] = 3;
  EXPECT_THROW(figures(evaluation.dump()), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
