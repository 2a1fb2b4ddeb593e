// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/evaluation_html.h"

#include "trysquare/core/error.h"
#include "trysquare/report/internal/charts.h"
#include "trysquare/report/internal/charts_series.h"
#include "trysquare/report/internal/format.h"
#include "trysquare/report/internal/format_headline.h"
#include "trysquare/report/internal/format_html.h"
#include "trysquare/report/internal/format_tables.h"
#include "trysquare/report/internal/json.h"
#include "trysquare/report/internal/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

using internal::Json;
using internal::WindowSeries;
using internal::WindowTable;

std::string figure_grid(const std::vector<std::string>& figures) {
  if (figures.empty()) return "";
  std::string html = fmt::format("<div class=\"figures{}\">\n", figures.size() == 1 ? " one" : "");
  for (const std::string& figure : figures) html += "<figure>" + figure + "</figure>\n";
  return html + "</div>\n";
}

/// The most telling two: MOM beside the RPE where there is a reference, else beside the MPV.
std::string heat_map_section(const Json& evaluation, const WindowTable& table) {
  constexpr std::size_t kNumHeatMaps = 2;
  const char* const heading = "Along the trajectory";
  if (table.windows.empty()) {
    return internal::html_section(
        heading, internal::html_paragraph("reason", "No windows: " + internal::reason_of(evaluation, "windows") + "."));
  }
  std::vector<std::string> maps;
  for (const WindowSeries& series : table.series) {
    if (maps.size() == kNumHeatMaps || !internal::has_value(series)) continue;
    const std::optional<internal::Drawing> map = internal::heat_map(evaluation, table.windows, series);
    if (map) maps.push_back(internal::inline_svg(*map));
  }
  if (maps.empty()) {
    const bool has_path = internal::has(evaluation, "trajectory");
    const std::string reason = has_path ? "every window is undefined" : internal::reason_of(evaluation, "trajectory");
    return internal::html_section(heading, internal::html_paragraph("reason", "Nothing to draw: " + reason + "."));
  }
  std::string note = fmt::format("{} windows, each colors the path of its scans.", table.windows.size());
  const Json& num_outside = evaluation.at("num_scans_outside_windows");
  if (table.windows.size() > 1 && table.windows[1].first <= table.windows[0].last) {
    note += " Where windows overlap, each colors the part around its middle.";
  }
  if (num_outside.get<std::size_t>() > 0) {
    note += fmt::format(" The last {} scans fill no window and stay thin and grey.", internal::count(num_outside));
  }
  return internal::html_section(heading, figure_grid(maps) + internal::html_paragraph("note", note));
}

/// "MOM is undefined in scans 20–29: no direction has points." One sentence per reason.
std::string undefined_notes(const WindowTable& table) {
  constexpr std::size_t kMaxNamed = 6;
  std::string html;
  for (const WindowSeries& series : table.series) {
    std::vector<std::pair<std::string, std::vector<std::string>>> windows_of_reason;
    for (std::size_t i = 0; i < table.windows.size(); ++i) {
      if (series.values[i]) continue;
      const auto known = std::find_if(windows_of_reason.begin(), windows_of_reason.end(),
                                      [&](const auto& entry) { return entry.first == series.reasons[i]; });
      const auto entry = known != windows_of_reason.end()
                             ? known
                             : windows_of_reason.insert(windows_of_reason.end(), {series.reasons[i], {}});
      entry->second.push_back(internal::window_label(table.windows[i]));
    }
    for (const auto& [reason, windows] : windows_of_reason) {
      const bool is_everywhere = windows.size() == table.windows.size();
      html += internal::html_paragraph(
          "note", fmt::format("{} is undefined in {}: {}.", series.name,
                              is_everywhere ? "every window" : internal::joined(windows, kMaxNamed), reason));
    }
  }
  return html;
}

std::string windows_section(const WindowTable& table) {
  if (table.windows.empty()) return "";
  std::vector<std::string> charts;
  bool has_limited = false;
  for (const WindowSeries& series : table.series) {
    if (internal::has_value(series))
      charts.push_back(internal::inline_svg(internal::window_chart(table.windows, series)));
    for (std::size_t i = 0; i < series.values.size(); ++i) {
      has_limited = has_limited || (series.is_limited[i] && series.values[i]);
    }
  }
  std::string html = figure_grid(charts);
  if (!charts.empty()) {
    html += internal::html_paragraph("note",
                                     "Each point is a window, drawn at its middle. Overlap: the mean number of scans "
                                     "in a neighborhood. Grey bands: undefined.");
  }
  if (has_limited) {
    html += internal::html_paragraph("note",
                                     "Hollow points: the scans of the window hardly overlap, or fewer than three "
                                     "orthogonal directions were found, so that the value does not follow the "
                                     "trajectory error.");
  }
  return internal::html_section("Over the windows", html + undefined_notes(table));
}

std::string text_or(const Json& object, const char* key, const std::string& otherwise) {
  return internal::has(object, key) ? object.at(key).get<std::string>() : otherwise;
}

std::string page_header(const Json& evaluation) {
  const Json& inputs = evaluation.at("inputs");
  const std::string definition = text_or(evaluation.at("settings"), "definition", "");
  std::string summary = fmt::format("{} scans, {} points", internal::count(inputs.at("num_scans")),
                                    internal::count(inputs.at("num_points")));
  if (internal::has(inputs, "poses")) summary += ", poses from " + inputs.at("poses").get<std::string>();
  if (!definition.empty()) summary += fmt::format("; definition “{}”", definition);
  return fmt::format(
      "<header><p class=\"product\">trysquare {} · evaluation</p>\n<h1>{}</h1>\n<p class=\"reason\">{}</p></header>\n",
      internal::escape(text_or(evaluation, "version", "")), internal::escape(text_or(inputs, "scans", "unnamed scans")),
      internal::escape(summary));
}

std::string page(const Json& evaluation) {
  const WindowTable table = internal::window_table(evaluation);
  const std::string title = internal::escape("trysquare: " + text_or(evaluation.at("inputs"), "scans", "evaluation"));
  // the policy makes the browser hold what is promised: nothing is loaded, nothing runs
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n";
  html += "<title>" + title + "</title>\n<style>" + internal::html_style() + "</style>\n</head>\n<body>\n";
  html += page_header(evaluation);
  html += internal::html_verdict(evaluation);
  html += internal::html_headline(evaluation);
  html += internal::html_warnings(evaluation);
  html += heat_map_section(evaluation, table);
  html += windows_section(table);
  html += internal::html_directions(evaluation);
  html += "<div class=\"columns\">\n" + internal::html_reference(evaluation) + internal::html_correlations(evaluation);
  html += "</div>\n<div class=\"columns\">\n" + internal::html_inputs(evaluation);
  html += internal::html_settings(evaluation) + "</div>\n";
  return html + "</body>\n</html>\n";
}

}  // namespace

std::string to_html(std::string_view evaluation_json) {
  try {
    return page(internal::parse(evaluation_json, internal::kEvaluationSchema));
  } catch (const Json::exception& error) {
    throw InvalidArgument(fmt::format("JSON: not as {} says: {}", internal::kEvaluationSchema, error.what()));
  }
}

}  // namespace trysquare
