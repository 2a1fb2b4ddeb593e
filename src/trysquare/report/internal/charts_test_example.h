// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/report/internal/json.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace trysquare::internal {

/// An evaluation of 40 scans on a left turn with four windows; the third has no MOM, in the second MOM does not follow
/// the trajectory error. For tests.
inline Json example_evaluation() {
  const Json counts =
      Json::parse(R"({"num_queries": 49056, "num_used": 48311, "num_degenerate": 17, "num_too_few": 728})");
  const auto metric = [&](double value, const char* unit) {
    Json json = {{"value", value}, {"unit", unit}};
    json.update(counts);
    return json;
  };
  Json evaluation = Json::parse(R"({
    "schema": "trysquare.evaluation/1", "version": "0.1.0",
    "inputs": {"scans": "velodyne", "poses": "poses.txt", "reference": null, "num_scans": 40, "num_points": 2452809},
    "settings": {"definition": "paper", "radius_m": 0.75, "max_range_m": null, "metrics": ["mme", "mom"],
                 "orthogonal_subset": {"linkage_cut": 0.1}},
    "metrics": {"omme": null, "omme_reason": "OMME was not asked for"},
    "overlap": {"scans_per_neighborhood_mean": 18.8125, "multi_scan_share": 0.998},
    "rpe_estimate": null, "rpe_estimate_reason": "no estimate in this version",
    "reference": null, "reference_reason": "no reference trajectory was given",
    "num_scans_outside_windows": 0, "window_correlations": [], "warnings": [],
    "verdict": {"meaningful": true, "reasons": []}})");
  evaluation["metrics"]["mme"] = metric(0.50291, "nats");
  evaluation["metrics"]["mpv"] = metric(0.0036, "m2");
  evaluation["metrics"]["mom"] = metric(0.0022034978851190544, "m2");
  evaluation["metrics"]["mom"].update(Json::parse(R"({"mean_of_means": 0.0022034978851190544, "sum_of_medians": 0.0061,
    "directions": [{"normal": [1, 0, 0], "num_points": 1371, "num_used": 1369, "mean": 0.0011, "median": 0.0009},
                   {"normal": null, "normal_reason": "no normals were given", "num_points": 20, "num_used": 0,
                    "mean": null, "median": null, "reason": "no point of the direction is defined"}],
    "follows_trajectory_error": true})"));
  Json positions = Json::array();
  for (int i = 0; i < 40; ++i) positions.push_back({20 * std::sin(0.03 * i), 20 * (1 - std::cos(0.03 * i)), 0.001 * i});
  evaluation["trajectory"] = {{"num_poses", 40}, {"path_length_m", 23.4}, {"positions_in_map_m", positions}};
  evaluation["windows"] = Json::array();
  for (int i = 0; i < 4; ++i) {
    Json window = {
        {"first", 10 * i}, {"last", 10 * i + 9}, {"mom", 0.001 * (i + 1)}, {"mpv", 0.002}, {"mme", -1.0 + i}};
    window["follows_trajectory_error"] = i != 1;
    window["overlap"] = {{"scans_per_neighborhood_mean", 8.5 + i}};
    if (i == 2) {
      window["mom"] = nullptr;
      window["mom_reason"] = "no direction has points";
    }
    evaluation["windows"].push_back(window);
  }
  return evaluation;
}

inline std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t num = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++num;
  return num;
}

/// What is wrong with the text as XML: elements that do not nest, attributes without quotes, bare '&' and '<'. Empty
/// when it is well formed. Knows neither comments nor CDATA, which the figures do not use.
inline std::string xml_fault(const std::string& xml) {
  std::vector<std::string> open;
  std::size_t at = xml.rfind("<?xml", 0) == 0 ? xml.find("?>") + 2 : 0;
  for (; at < xml.size(); ++at) {
    if (xml[at] == '&') {
      const std::string entity = xml.substr(at, xml.find(';', at) - at + 1);
      if (entity != "&amp;" && entity != "&lt;" && entity != "&gt;" && entity != "&quot;" && entity != "&#39;") {
        return "bare & at " + std::to_string(at);
      }
    }
    if (xml[at] != '<') continue;
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return "a tag does not end";
    std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string::npos) return "'<' in the tag " + tag;
    const bool is_empty = !tag.empty() && tag.back() == '/';
    const std::string name = tag.substr(0, tag.find_first_of(" />", 1));
    if (tag.front() == '/') {
      if (open.empty() || "/" + open.back() != tag) return "unexpected <" + tag + ">";
      open.pop_back();
    } else {
      if (occurrences(tag, "\"") != 2 * occurrences(tag, "=\"") || occurrences(tag, "=") < occurrences(tag, "=\"")) {
        return "quotes in <" + tag + ">";
      }
      if (!is_empty) open.push_back(name);
    }
    at = end;
  }
  return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

}  // namespace trysquare::internal
