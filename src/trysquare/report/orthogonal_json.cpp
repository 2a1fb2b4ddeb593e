// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/orthogonal_json.h"

#include "trysquare/report/internal/json.h"
#include "trysquare/report/internal/orthogonal_settings_json.h"
#include "trysquare/report/internal/statistics_json.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <utility>

namespace trysquare {
namespace {

using internal::Json;

/// In [0, 90]: a normal has no sign. By atan2, as acos loses half the digits near 0.
double angle_between_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) * internal::kDegreesPerRadian;
}

Json direction_json(const OrthogonalSubset::Direction& direction) {
  Json json;
  json["normal"] = internal::array_of(direction.normal_in_map);
  json["num_points"] = direction.points_in_map.size();
  return json;
}

Json angles_json(const OrthogonalSubset& subset) {
  Json angles = Json::array();
  for (std::size_t i = 0; i < subset.directions.size(); ++i) {
    for (std::size_t j = i + 1; j < subset.directions.size(); ++j) {
      const Eigen::Vector3d& a = subset.directions[i].normal_in_map;
      const Eigen::Vector3d& b = subset.directions[j].normal_in_map;
      angles.push_back({{"directions", {i, j}}, {"angle_deg", angle_between_deg(a, b)}});
    }
  }
  return angles;
}

Json window_json(const OrthogonalWindow& window, bool is_first) {
  Json json = {{"first", window.first},
               {"last", window.last},
               {"num_points", window.num_points},
               {"num_planar", window.num_planar}};
  json["directions"] = Json::array();
  for (const OrthogonalWindow::Direction& direction : window.directions) {
    Json of_direction;
    of_direction["normal"] = internal::array_of(direction.normal_in_map);
    of_direction["num_points"] = direction.num_points;
    if (direction.moved_rad) {
      of_direction["moved_deg"] = *direction.moved_rad * internal::kDegreesPerRadian;
    } else {
      of_direction["moved_deg"] = nullptr;
      of_direction["moved_reason"] = is_first ? "the first window" : "the window before has none within 45 degrees";
    }
    json["directions"].push_back(std::move(of_direction));
  }
  json["reason"] = window.reason.empty() ? Json(nullptr) : Json(window.reason);
  return json;
}

}  // namespace

std::string to_json(const OrthogonalSubsetResult& result, const OrthogonalSubsetSettings& settings,
                    const OrthogonalFacts& facts, std::span<const OrthogonalWindow> windows) {
  Json json = {{"schema", "trysquare.orthogonal/1"}, {"version", facts.version}};
  const auto text_or_null = [](const std::optional<std::string>& text) { return text ? Json(*text) : Json(nullptr); };
  json["inputs"] = {{"scans", facts.scans},
                    {"poses", text_or_null(facts.poses)},
                    {"left_handed", facts.left_handed},
                    {"extrinsic", text_or_null(facts.extrinsic)},
                    {"num_scans", facts.num_scans}};
  json["settings"] = internal::orthogonal_settings_json(settings);
  json["settings"]["radius_m"] = facts.radius_m;
  json["directions"] = Json::array();
  for (const auto& direction : result.subset.directions) json["directions"].push_back(direction_json(direction));
  json["angles"] = angles_json(result.subset);
  json["num_points"] = result.num_points;
  json["num_planar"] = result.num_planar;
  json["planar_share"] = internal::number_or_null(result.planar_share());
  json["num_clusters"] = result.num_clusters;
  json["follows_trajectory_error"] = result.subset.directions.size() == 3;
  json["reason"] = result.reason.empty() ? Json(nullptr) : Json(result.reason);
  json["windows"] = Json::array();
  for (const OrthogonalWindow& window : windows) {
    json["windows"].push_back(window_json(window, json["windows"].empty()));
  }
  if (windows.empty()) json["windows_reason"] = facts.windows_reason;
  return internal::dump(json);
}

}  // namespace trysquare
