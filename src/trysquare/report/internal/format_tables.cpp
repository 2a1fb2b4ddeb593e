// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/format_tables.h"

#include "trysquare/report/internal/format.h"
#include "trysquare/report/internal/format_html.h"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

namespace trysquare::internal {
namespace {

struct Column {
  std::string heading;
  const Json* statistics = nullptr;
};

/// Rows are the statistics and columns the errors: three columns fit on a phone, six would not.
std::string statistics_table(const std::vector<Column>& columns) {
  std::vector<std::string> head = {""};
  for (const Column& column : columns) head.push_back(escape(column.heading));
  std::string body;
  for (const char* const key : {"rmse", "mean", "median", "std", "min", "max"}) {
    body += fmt::format("<tr><th scope=\"row\">{}</th>", key);
    for (const Column& column : columns) {
      body += html_cell("", html_value(*column.statistics, key, column.statistics->at("unit").get<std::string>()));
    }
    body += "</tr>\n";
  }
  body += "<tr><th scope=\"row\">number of</th>";
  for (const Column& column : columns) {
    const bool is_of_pairs = has(*column.statistics, "num_pairs");
    body += html_cell("", count(column.statistics->at(is_of_pairs ? "num_pairs" : "num_poses")) +
                              (is_of_pairs ? " pairs" : " poses"));
  }
  return html_table("numbers", html_row("th", head), body + "</tr>\n");
}

std::string normal_text(const Json& direction) {
  if (!has(direction, "normal")) return html_undefined(reason_of(direction, "normal"));
  std::string text;
  for (const Json& coordinate : direction.at("normal")) {
    text += (text.empty() ? "(" : ", ") + tick_label(coordinate.get<double>(), 0.001);
  }
  return text + ")";
}

std::string directions_table(const Json& metric, const std::string& unit) {
  std::string body;
  std::size_t number = 0;
  for (const Json& direction : metric.at("directions")) {
    const std::string used =
        fmt::format("{} of {}", count(direction.at("num_used")), count(direction.at("num_points")));
    std::vector<std::string> cells = {std::to_string(++number), normal_text(direction), used};
    if (has(direction, "mean") && has(direction, "median")) {
      cells.push_back(html_value(direction, "mean", unit));
      cells.push_back(html_value(direction, "median", unit));
      body += html_row("td", cells);
    } else {
      const std::string row = html_row("td", cells);
      body += row.substr(0, row.rfind("</tr>")) + "<td class=\"reason\" colspan=\"2\">" +
              html_undefined(reason_of(direction, "mean")) + "</td></tr>\n";
    }
  }
  return html_table("numbers", html_row("th", {"", "normal in the map frame", "points used", "mean", "median"}), body);
}

std::string directions_of(const Json& metrics, const std::string& key, const char* name) {
  if (!has(metrics, key)) return "";
  const Json& metric = metrics.at(key);
  const std::string unit = metric.at("unit").get<std::string>();
  std::string html = "<h3>" + escape(name) + "</h3>\n";
  if (metric.at("directions").empty()) {
    html += html_paragraph("reason", "No orthogonal direction was found: " + reason_of(metric, "value"));
  } else {
    html += directions_table(metric, unit);
  }
  if (has(metric, "mean_of_means") && has(metric, "sum_of_medians")) {
    html += fmt::format("<p class=\"note\">Mean of the means {}; sum of the medians {}.</p>\n",
                        html_value(metric, "mean_of_means", unit), html_value(metric, "sum_of_medians", unit));
  }
  return html;
}

}  // namespace

std::string html_directions(const Json& evaluation) {
  const Json& metrics = evaluation.at("metrics");
  return html_section("Orthogonal directions",
                      directions_of(metrics, "mom", "MOM: variance along the normal of the surfaces") +
                          directions_of(metrics, "omme", "OMME: entropy of the surfaces"));
}

std::string html_reference(const Json& evaluation) {
  const char* const heading = "Errors against the reference";
  if (!has(evaluation, "reference")) {
    return html_section(heading, html_paragraph("reason", "None: " + reason_of(evaluation, "reference") + "."));
  }
  const Json& reference = evaluation.at("reference");
  std::vector<Column> columns;
  std::string undefined;
  const auto add = [&](const std::string& key, const char* name) {
    if (has(reference, key)) {
      columns.push_back({name, &reference.at(key)});
    } else {
      undefined += html_paragraph("note", fmt::format("{} is undefined: {}.", name, reason_of(reference, key)));
    }
  };
  add("rpe", "RPE, translation");
  add("rpe_rotation", "RPE, rotation");
  add("ape", "APE");
  std::string html = (columns.empty() ? "" : statistics_table(columns)) + undefined;
  const std::string unit = has(reference, "paper_rpe_unit") ? reference.at("paper_rpe_unit").get<std::string>() : "m2";
  html += fmt::format(
      "<p class=\"note\">RPE over all pairs of poses; APE of the positions after the best rigid alignment. The RPE as "
      "the "
      "paper defines it, mean over the poses of the sum of squares: {}.</p>\n",
      html_value(reference, "paper_rpe", unit));
  return html_section(heading, html);
}

std::string html_correlations(const Json& evaluation) {
  const Json& correlations = evaluation.at("window_correlations");
  if (correlations.empty()) return "";
  std::string body;
  for (const Json& entry : correlations) {
    std::string name = entry.at("metric").get<std::string>();
    for (char& c : name) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    std::string row = fmt::format("<tr><th scope=\"row\">{}</th>", escape(name));
    row += html_cell("", count(entry.at("num_windows")));
    const bool is_defined = has(entry, "pearson") || has(entry, "spearman") || has(entry, "kendall_tau_b");
    if (is_defined) {
      for (const char* const key : {"pearson", "spearman", "kendall_tau_b"}) {
        row += html_cell("", has(entry, key) ? tick_label(entry.at(key).get<double>(), 0.001)
                                             : html_undefined(reason_of(entry, key)));
      }
    } else {
      row += "<td class=\"reason\" colspan=\"3\">" + html_undefined(reason_of(entry, "pearson")) + "</td>";
    }
    body += row + "</tr>\n";
  }
  const std::string head = html_row("th", {"", "windows", "Pearson", "Spearman", "Kendall τ<sub>b</sub>"});
  return html_section("How the metrics go along with the RPE of the windows",
                      html_table("numbers", head, body) +
                          html_paragraph("note",
                                         "Correlation over the windows between each metric and the RPE against the "
                                         "reference: 1 means that both rank the windows alike."));
}

std::string html_inputs(const Json& evaluation) {
  std::string rows = html_fact_rows(evaluation.at("inputs"), "");
  if (has(evaluation, "trajectory") && has(evaluation.at("trajectory"), "path_length_m")) {
    rows += fmt::format("<tr><th scope=\"row\">length of the path</th><td>{}</td></tr>\n",
                        html_value(evaluation.at("trajectory"), "path_length_m", "m"));
  }
  return html_section("Inputs", html_table("facts", "", rows));
}

std::string html_settings(const Json& evaluation) {
  return html_section("Settings", html_table("facts", "", html_fact_rows(evaluation.at("settings"), "")));
}

}  // namespace trysquare::internal
