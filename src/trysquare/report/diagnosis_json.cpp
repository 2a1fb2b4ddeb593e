// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/diagnosis_json.h"

#include "trysquare/report/internal/json.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <vector>

namespace trysquare {
namespace {

using internal::Json;
using internal::number_or_null;

constexpr std::string_view kSchema = "trysquare.diagnosis/1";
constexpr double kDegrees = 180 / std::numbers::pi;

Json matrix_of(const Pose& pose) {
  Json rows = Json::array();
  for (Eigen::Index row = 0; row < 3; ++row) {
    Json numbers = internal::array_of(pose.rotation.row(row).transpose());
    numbers.push_back(number_or_null(pose.translation(row)));
    rows.push_back(std::move(numbers));
  }
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return rows;
}

std::size_t count_of(Severity severity, const std::vector<Finding>& findings) {
  const auto is_one = [&](const Finding& finding) { return finding.severity == severity; };
  return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(), is_one));
}

Json finding_json(const Finding& finding) {
  Json json = {{"id", finding.id},
               {"severity", name_of(finding.severity)},
               {"message", finding.message},
               {"remedy", finding.remedy}};
  if (finding.evidence) {
    json["evidence"] = {{"found", number_or_null(finding.evidence->found)},
                        {"limit", number_or_null(finding.evidence->limit)},
                        {"unit", finding.evidence->unit}};
  } else {
    json["evidence"] = nullptr;
    json["evidence_reason"] = "the message holds what there is";
  }
  return json;
}

Json estimate_json(const RpeEstimate& estimate) {
  const std::string refused = "the estimate is refused: see reasons";
  Json json = {{"status", name_of(estimate.status)}, {"reasons", estimate.reasons}};
  internal::set_or_explain(json, "translation_rms_m", estimate.translation_rms_m, refused);
  const auto rotation_deg =
      estimate.rotation_rms_rad ? std::optional(*estimate.rotation_rms_rad * kDegrees) : std::nullopt;
  internal::set_or_explain(json, "rotation_rms_deg", rotation_deg, refused);
  return json;
}

Json time_offset_json(const TimeOffset& time) {
  Json json;
  internal::set_or_explain(json, "offset_s", time.offset_s, time.reason);
  internal::set_or_explain(json, "resolution_s", time.resolution_s,
                           time.reason.empty() ? "the motion is too steady" : time.reason);
  json["num_scans"] = time.num_scans;
  json["costs"] = Json::array();
  for (const TimeOffsetCost& cost : time.costs) {
    json["costs"].push_back({{"offset_s", number_or_null(cost.offset_s)}, {"error_m", number_or_null(cost.error_m)}});
  }
  return json;
}

Json interval_json(const std::array<double, 2>& interval, double unit) {
  return {number_or_null(unit * interval[0]), number_or_null(unit * interval[1])};
}

Json suspect_json(const SuspectPose& pose) {
  return {{"scan", pose.scan},
          {"translation_error_m", number_or_null(pose.translation_m)},
          {"translation_interval_m", interval_json(pose.translation_interval_m, 1)},
          {"rotation_error_deg", number_or_null(pose.rotation_rad * kDegrees)},
          {"rotation_interval_deg", interval_json(pose.rotation_interval_rad, kDegrees)},
          {"score", number_or_null(pose.score)}};
}

Json group_json(const PoseGroup& group) {
  return {{"first_scan", group.first},
          {"last_scan", group.last},
          {"is_drift", group.is_drift},
          {"translation_error_m", number_or_null(group.translation_m)},
          {"rotation_error_deg", number_or_null(group.rotation_rad * kDegrees)}};
}

Json jump_json(const PoseJump& jump) {
  return {{"from_scan", jump.from},
          {"to_scan", jump.from + 1},
          {"translation_error_m", number_or_null(jump.translation_m)},
          {"translation_limit_m", number_or_null(jump.limit_m)},
          {"rotation_error_deg", number_or_null(jump.rotation_rad * kDegrees)},
          {"rotation_limit_deg", number_or_null(jump.limit_rad * kDegrees)}};
}

Json off_path_json(const PoseOffPath& pose) {
  return {
      {"scan", pose.scan}, {"distance_m", number_or_null(pose.distance_m)}, {"limit_m", number_or_null(pose.limit_m)}};
}

Json wall_json(const GhostWall& wall) {
  Json json = {{"center_in_map_m", internal::array_of(wall.center_in_map)},
               {"normal_in_map", internal::array_of(wall.normal_in_map)},
               {"distance_m", number_or_null(wall.distance_m)},
               {"limit_m", number_or_null(wall.limit_m)},
               {"noise_m", number_or_null(wall.noise_m)},
               {"extent_m", number_or_null(wall.extent_m)},
               {"num_patches", wall.num_patches},
               {"lower_scans", wall.lower_scans},
               {"upper_scans", wall.upper_scans}};
  internal::set_or_explain(json, "adjusted_distance_m", wall.adjusted_m, "there are no adjusted poses that see it");
  return json;
}

/// object[key] = the list; null and its reason where there is one.
template <class Items, class ToJson>
void set_list_or_explain(Json& object, const std::string& key, const Items& items, const std::string& reason,
                         const ToJson& to_json_of) {
  object[key] = reason.empty() ? Json::array() : Json(nullptr);
  if (!reason.empty()) object[key + "_reason"] = reason;
  if (!reason.empty()) return;
  for (const auto& item : items) object[key].push_back(to_json_of(item));
}

std::string cell(const Json& value) { return value.is_null() ? "" : value.dump(); }

/// A text in quotes, as RFC 4180 has it.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

}  // namespace

std::string to_json(const Diagnosis& diagnosis, const DiagnosisSettings& settings, const DiagnosisFacts& facts) {
  Json json = {{"schema", kSchema}, {"version", facts.version}};
  json["inputs"] = {{"scans", facts.scans},
                    {"poses", facts.poses},
                    {"poses_format", facts.poses_format},
                    {"left_handed", facts.left_handed},
                    {"extrinsic", facts.extrinsic ? Json(*facts.extrinsic) : Json(nullptr)},
                    {"num_scans", diagnosis.num_scans}};
  json["settings"] = {{"radius_m", settings.radius_m}, {"max_time_offset_s", settings.max_time_offset_s}};
  json["judged"] = diagnosis.reason.empty();
  if (!diagnosis.reason.empty()) json["judged_reason"] = diagnosis.reason;
  json["num_errors"] = count_of(Severity::kError, diagnosis.findings);
  json["num_warnings"] = count_of(Severity::kWarning, diagnosis.findings);
  json["findings"] = Json::array();
  for (const Finding& finding : diagnosis.findings) json["findings"].push_back(finding_json(finding));
  const std::string& blame = diagnosis.reason.empty() ? diagnosis.blame_reason : diagnosis.reason;
  json["rpe_estimate"] = diagnosis.estimate ? estimate_json(*diagnosis.estimate) : Json(nullptr);
  if (!diagnosis.estimate) json["rpe_estimate_reason"] = blame;
  TimeOffset time = diagnosis.time_offset;
  if (!diagnosis.reason.empty()) time.reason = diagnosis.reason;
  json["time_offset"] = time_offset_json(time);
  const std::string& no_suspects = diagnosis.reason.empty() ? diagnosis.suspects_reason : diagnosis.reason;
  set_list_or_explain(json, "suspects", diagnosis.suspects.poses, no_suspects, suspect_json);
  set_list_or_explain(json, "groups", diagnosis.suspects.groups, no_suspects, group_json);
  set_list_or_explain(json, "jumps", diagnosis.jumps, no_suspects, jump_json);
  set_list_or_explain(json, "poses_off_path", diagnosis.off_path, blame, off_path_json);
  set_list_or_explain(json, "ghost_walls", diagnosis.ghost_walls, blame, wall_json);
  json["world_from_map"] = matrix_of(diagnosis.world_from_map);
  return internal::dump(json);
}

std::string findings_csv(std::string_view diagnosis_json) {
  const Json diagnosis = internal::parse(diagnosis_json, kSchema);
  std::string text = "id,severity,found,limit,unit,message,remedy\n";
  for (const Json& finding : diagnosis.at("findings")) {
    const Json& evidence = finding.at("evidence");
    text += finding.at("id").get<std::string>() + "," + finding.at("severity").get<std::string>() + ",";
    text += evidence.is_null() ? ",,"
                               : cell(evidence.at("found")) + "," + cell(evidence.at("limit")) + "," +
                                     evidence.at("unit").get<std::string>();
    text += "," + quoted(finding.at("message").get<std::string>()) + "," +
            quoted(finding.at("remedy").get<std::string>()) + "\n";
  }
  return text;
}

}  // namespace trysquare
