// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/evaluation_html.h"

#include "trysquare/core/error.h"
#include "trysquare/report/internal/charts_test_example.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace trysquare {
namespace {

using internal::example_evaluation;
using internal::Json;
using testing::HasSubstr;
using testing::Not;

std::string html_of(const Json& evaluation) { return to_html(evaluation.dump()); }

TEST(EvaluationHtml, LoadsAndRunsNothing) {
  const std::string html = html_of(example_evaluation());
  for (const char* const forbidden : {"<script", "javascript:", "http:", "https:", "src=", "href", "url(", "@import",
                                      "<link", "<iframe", " onload"}) {
    EXPECT_THAT(html, Not(HasSubstr(forbidden)));
  }
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
}

/// Every string of the JSON, wherever it is shown, is text and never markup.
void make_hostile(Json& json) {
  if (json.is_string() && json != "trysquare.evaluation/1") json = json.get<std::string>() + "<script>&\"'";
  if (json.is_structured()) {
    for (Json& element : json) make_hostile(element);
  }
}

TEST(EvaluationHtml, EveryStringOfTheJsonIsEscaped) {
  Json evaluation = example_evaluation();
  evaluation["warnings"] = Json::parse(R"([{"code": "c", "message": "m"}])");
  evaluation["verdict"] = Json::parse(R"({"meaningful": false, "reasons": ["r"]})");
  evaluation["settings"]["<script>key"] = 1;
  evaluation["reference"] = Json::parse(R"({"rpe": null, "rpe_reason": "r1", "rpe_rotation": null, "ape": null,
                                            "reason": "r2", "paper_rpe": null, "paper_rpe_reason": "r3"})");
  evaluation["window_correlations"] =
      Json::parse(R"([{"metric": "mom", "num_windows": 2, "pearson": null, "reason": "few"}])");
  make_hostile(evaluation);
  const std::string html = html_of(evaluation);
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("&\"'")));
  EXPECT_GT(internal::occurrences(html, "&lt;script&gt;&amp;&quot;&#39;"), 15U);
}

TEST(EvaluationHtml, FiguresAreWellFormed) {
  Json evaluation = example_evaluation();
  evaluation["windows"][2]["mom_reason"] = "</title><b>&\"";
  const std::string html = html_of(evaluation);
  std::size_t num_figures = 0;
  for (std::size_t at = html.find("<svg"); at != std::string::npos; at = html.find("<svg", at + 1)) {
    EXPECT_EQ(internal::xml_fault(html.substr(at, html.find("</svg>", at) + 6 - at)), "");
    ++num_figures;
  }
  EXPECT_EQ(num_figures, 2U + 4U);  // two heat maps; MOM, MPV, MME, overlap over the windows
}

TEST(EvaluationHtml, ShowsTheVerdictBeforeTheNumbers) {
  const std::string good = html_of(example_evaluation());
  EXPECT_THAT(good, HasSubstr("The numbers are meaningful"));
  Json evaluation = example_evaluation();
  evaluation["verdict"] = Json::parse(R"({"meaningful": false, "reasons": ["the scans lie apart"]})");
  const std::string bad = html_of(evaluation);
  EXPECT_THAT(bad, Not(HasSubstr("The numbers are meaningful")));
  EXPECT_THAT(bad, HasSubstr("The numbers are not meaningful"));
  EXPECT_LT(bad.find("the scans lie apart"), bad.find("class=\"card\""));
}

TEST(EvaluationHtml, HeadlineNumbersHaveUnitsAndWallsAThickness) {
  const std::string html = html_of(example_evaluation());
  EXPECT_THAT(html, HasSubstr("<p class=\"number\">0.002203\u00A0m²</p>"));
  EXPECT_THAT(html, HasSubstr("46.94\u00A0mm</b> (√MOM)"));  // sqrt(0.0022034978...) m
  EXPECT_THAT(html, HasSubstr("60.00\u00A0mm</b> (√MPV)"));  // sqrt(0.0036) m
  EXPECT_THAT(html, HasSubstr("0.5029\u00A0nats"));
  EXPECT_THAT(html, HasSubstr("18.81\u00A0scans"));
  EXPECT_THAT(html, HasSubstr("99.80\u00A0%"));
  EXPECT_THAT(html, HasSubstr("<td>0.75\u00A0m</td>"));  // the radius, as it was set
}

TEST(EvaluationHtml, WhatIsUndefinedShowsItsReason) {
  Json evaluation = example_evaluation();
  evaluation["metrics"]["mpv"]["value"] = nullptr;
  evaluation["metrics"]["mpv"]["reason"] = "no neighborhood has six points";
  const std::string html = html_of(evaluation);
  EXPECT_THAT(html, HasSubstr("OMME was not asked for"));
  EXPECT_THAT(html, HasSubstr("no neighborhood has six points"));
  EXPECT_THAT(html, HasSubstr("no estimate in this version"));
  EXPECT_THAT(html, HasSubstr("no reference trajectory was given"));
  EXPECT_THAT(html, HasSubstr("no point of the direction is defined"));
  EXPECT_THAT(html, HasSubstr("no normals were given"));
  EXPECT_THAT(html, Not(HasSubstr("√MPV")));
}

TEST(EvaluationHtml, UndefinedWindowsAreNamedWithTheReason) {
  EXPECT_THAT(html_of(example_evaluation()), HasSubstr("MOM is undefined in scans 20–29: no direction has points."));
}

TEST(EvaluationHtml, WithoutWindowsThereIsTheReasonAndNoFigure) {
  Json evaluation = example_evaluation();
  evaluation["windows"] = Json::array();
  evaluation["windows_reason"] = "a window of 50 scans does not fit into 40";
  const std::string html = html_of(evaluation);
  EXPECT_THAT(html, HasSubstr("a window of 50 scans does not fit into 40"));
  EXPECT_THAT(html, Not(HasSubstr("<svg")));
}

TEST(EvaluationHtml, ErrorsAgainstTheReferenceAreShown) {
  Json evaluation = example_evaluation();
  evaluation["reference"] = Json::parse(R"({
    "rpe": {"unit": "m", "num_pairs": 780, "rmse": 0.5703, "mean": 1, "median": 2, "std": 3, "min": 4, "max": 5},
    "rpe_rotation": {"unit": "deg", "num_pairs": 780, "rmse": 0.94, "mean": 1, "median": 2, "std": 3, "min": 4, "max": 5},
    "ape": null, "ape_reason": "the positions lie on a line", "paper_rpe": 0.0123, "paper_rpe_unit": "m2"})");
  for (Json& window : evaluation["windows"]) window["rpe_m"] = 0.04;
  evaluation["window_correlations"] =
      Json::parse(R"([{"metric": "mom", "num_windows": 3, "pearson": 0.9516, "spearman": 1, "kendall_tau_b": -0.25}])");
  const std::string html = html_of(evaluation);
  EXPECT_THAT(html, HasSubstr("<p class=\"number\">0.5703\u00A0m</p>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"\">0.9400°</td>"));
  EXPECT_THAT(html, HasSubstr("APE is undefined: the positions lie on a line."));
  EXPECT_THAT(html, HasSubstr("0.01230\u00A0m²"));
  EXPECT_THAT(html, HasSubstr("RPE, reference [mm]"));
  EXPECT_THAT(html, HasSubstr("0.952"));
  EXPECT_THAT(html, HasSubstr("−0.250"));
}

TEST(EvaluationHtml, WarningsAreShown) {
  EXPECT_THAT(html_of(example_evaluation()), Not(HasSubstr("Warnings")));
  Json evaluation = example_evaluation();
  evaluation["warnings"] = Json::parse(R"([{"code": "camera-frame", "message": "the poses seem to be in it"}])");
  EXPECT_THAT(html_of(evaluation), HasSubstr("<code>camera-frame</code> the poses seem to be in it"));
}

TEST(EvaluationHtml, OfAnythingButAnEvaluationIsRefused) {
  EXPECT_THROW(to_html(""), InvalidArgument);
  EXPECT_THROW(to_html("[1, 2]"), InvalidArgument);
  EXPECT_THROW(to_html(R"({"schema": "trysquare.evaluation/2"})"), InvalidArgument);
  Json evaluation = example_evaluation();
  evaluation.erase("verdict");
  EXPECT_THROW(html_of(evaluation), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
