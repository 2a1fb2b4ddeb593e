// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/evaluation_csv.h"

#include "trysquare/report/internal/json.h"

namespace trysquare {
namespace {

using internal::Json;

/// The number as the JSON has it, nothing for null.
std::string cell(const Json& value) { return value.is_null() ? "" : value.dump(); }

std::string error_cells(const Json& pose) {
  std::string text;
  for (const Json& coordinate : pose.at("translation_error_m")) text += "," + cell(coordinate);
  for (const char* key : {"sigma_m", "score", "suspect"}) text += "," + cell(pose.at(key));
  return text;
}

}  // namespace

std::string windows_csv(std::string_view evaluation_json) {
  const Json evaluation = internal::parse(evaluation_json, internal::kEvaluationSchema);
  std::string text = "first,last,mom_m2,omme_nats,mpv_m2,mme_nats,multi_scan_share,scans_per_neighborhood,rpe_estimate_m,rpe_m\n";
  for (const Json& window : evaluation.at("windows")) {
    const Json& overlap = window.at("overlap");
    text += cell(window.at("first")) + "," + cell(window.at("last"));
    for (const char* key : {"mom", "omme", "mpv", "mme"}) text += "," + cell(window.at(key));
    for (const char* key : {"multi_scan_share", "scans_per_neighborhood_mean"}) text += "," + cell(overlap.at(key));
    for (const char* key : {"rpe_estimate_m", "rpe_m"}) text += "," + cell(window.at(key));
    text += "\n";
  }
  return text;
}

std::string poses_csv(std::string_view evaluation_json) {
  const Json evaluation = internal::parse(evaluation_json, internal::kEvaluationSchema);
  std::string text = "index,x_m,y_m,z_m,error_x_m,error_y_m,error_z_m,sigma_m,score,suspect\n";
  if (evaluation.at("trajectory").is_null()) return text;
  const Json& estimate = evaluation.at("rpe_estimate");
  const bool has_errors = !estimate.is_null() && !estimate.at("poses").empty();
  std::size_t index = 0;
  for (const Json& position : evaluation.at("trajectory").at("positions_in_map_m")) {
    text += std::to_string(index);
    for (const Json& coordinate : position) text += "," + cell(coordinate);
    text += has_errors ? error_cells(estimate.at("poses").at(index)) : ",,,,,,";
    text += "\n";
    ++index;
  }
  return text;
}

}  // namespace trysquare
