// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/trajectory_json.h"

#include "trysquare/report/internal/json.h"
#include "trysquare/report/internal/statistics_json.h"
#include "trysquare/stats/quantile.h"
#include "trysquare/trajectory/error_unit.h"

#include <fmt/format.h>

#include <algorithm>

namespace trysquare {
namespace {

using internal::Json;

template <class T>
Json value_or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json statistics_json(const ErrorStatistics& statistics) {
  Json json = Json::object();
  internal::set_statistics(json, statistics);
  return json;
}

/// 4×4, row by row.
Json matrix_json(const Pose& pose) {
  Json numbers = Json::array();
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) numbers.push_back(pose.rotation(i, j));
    numbers.push_back(pose.translation[i]);
  }
  for (const double last : {0.0, 0.0, 0.0, 1.0}) numbers.push_back(last);
  return numbers;
}

void add_preparation(Json& settings, const TrajectoryPreparation& preparation) {
  settings["t_max_diff_s"] = preparation.association.max_difference_s;
  settings["t_offset_s"] = preparation.association.offset_s;
  settings["one_to_one"] = preparation.association.one_to_one;
  settings["interpolate"] = preparation.association.interpolate;
  settings["max_gap_s"] = preparation.association.max_gap_s;
  settings["t_start_s"] = value_or_null(preparation.t_start_s);
  settings["t_end_s"] = value_or_null(preparation.t_end_s);
  settings["downsample"] = value_or_null(preparation.downsample);
  settings["motion_filter"] = nullptr;
  if (preparation.motion_filter_m_deg) {
    settings["motion_filter"] = {{"distance_m", preparation.motion_filter_m_deg->at(0)},
                                 {"angle_deg", preparation.motion_filter_m_deg->at(1)}};
  }
  settings["transform_left"] = text_or_null(preparation.transform_left);
  settings["transform_right"] = text_or_null(preparation.transform_right);
  settings["extrinsic"] = text_or_null(preparation.extrinsic);
}

/// Share as text → value.
Json quantiles_json(const TrajectoryErrors& errors, const std::vector<double>& shares) {
  std::vector<double> sorted = errors.errors;
  std::sort(sorted.begin(), sorted.end());
  Json json = Json::object();
  for (const double share : shares) json[fmt::format("{}", share)] = quantile_of_sorted(sorted, share);
  return json;
}

Json hand_eye_json(const HandEye& found) {
  return {{"body_from_sensor", matrix_json(found.body_from_sensor)},
          {"translation_rms_m", found.translation_rms_m},
          {"rotation_rms_deg", found.rotation_rms_rad * internal::kDegreesPerRadian},
          {"num_motions", found.num_motions}};
}

Json drift_json(const std::optional<Drift>& drift) {
  if (!drift) {
    return {{"translation_percent", nullptr}, {"rotation_deg_per_100m", nullptr}, {"num_segments", 0}};
  }
  return {{"translation_percent", drift->translation_percent},
          {"rotation_deg_per_100m", drift->rotation_deg_per_100m},
          {"num_segments", drift->num_segments}};
}

Json kitti_drift_json(const KittiDrift& drift) {
  Json json = drift_json(drift.mean);
  json["path_length_m"] = drift.path_length_m;
  json["by_length"] = Json::array();
  for (const KittiDrift::OfLength& of_length : drift.by_length) {
    Json entry = {{"length_m", of_length.length_m}};
    entry.update(drift_json(of_length.drift));
    json["by_length"].push_back(entry);
  }
  if (!drift.reason.empty()) json["reason"] = drift.reason;
  return json;
}

Json by_length_json(const std::vector<ErrorOfLength>& errors) {
  Json json = Json::array();
  for (const ErrorOfLength& error : errors) {
    Json of_length = {{"length_m", error.length_m},
                      {"num_pairs", error.translation_m ? error.translation_m->count : 0},
                      {"translation_m", nullptr},
                      {"translation_percent", nullptr},
                      {"rotation_deg", nullptr}};
    if (error.translation_m) {
      of_length["translation_m"] = statistics_json(*error.translation_m);
      of_length["translation_percent"] = statistics_json(*error.translation_percent);
      of_length["rotation_deg"] = statistics_json(internal::in_degrees(*error.rotation_rad));
    } else {
      of_length["reason"] = error.reason;
    }
    json.push_back(of_length);
  }
  return json;
}

/// What APE and RPE have in common.
Json common_json(const char* metric, const TrajectoryErrors& errors, Alignment alignment,
                 std::size_t num_poses_to_align, std::optional<Plane> projection, const TrajectoryErrorsFacts& facts) {
  Json json = {{"schema", "trysquare.trajectory/1"}, {"version", facts.version}, {"metric", metric}};
  json["inputs"] = {{"reference", facts.reference},
                    {"estimate", facts.estimate},
                    {"num_associated", facts.num_associated},
                    {"num_unmatched_reference", facts.num_unmatched_reference},
                    {"num_unmatched_estimate", facts.num_unmatched_estimate},
                    {"num_extrapolated", facts.num_extrapolated},
                    {"median_time_difference_s", value_or_null(facts.median_time_difference_s)}};
  json["settings"] = {{"pose_relation", name_of(errors.relation)},
                      {"alignment", name_of(alignment)},
                      {"num_poses_to_align", num_poses_to_align},
                      {"project_to_plane", projection ? Json(name_of(*projection)) : Json(nullptr)}};
  add_preparation(json["settings"], facts.preparation);
  if (facts.hand_eye) json["estimated_extrinsic"] = hand_eye_json(*facts.hand_eye);
  json["warnings"] = Json::array();
  for (const Diagnostic& warning : facts.warnings) {
    json["warnings"].push_back({{"code", warning.code}, {"message", warning.message}});
  }
  json["unit"] = unit_of(errors);
  json["num_pairs"] = errors.errors.size();
  if (errors.errors.empty()) {
    json["statistics"] = nullptr;
    json["quantiles"] = nullptr;
    json["scale"] = nullptr;
    json["reason"] = facts.reason;
    return json;
  }
  json["statistics"] = statistics_json(errors.statistics);
  json["quantiles"] = quantiles_json(errors, facts.quantiles);
  json["scale"] = errors.reference_from_estimate.scale;
  return json;
}

}  // namespace

std::string to_json(const TrajectoryErrors& errors, const ApeSettings& settings, const TrajectoryErrorsFacts& facts) {
  return internal::dump(
      common_json("ape", errors, settings.alignment, settings.num_poses_to_align, settings.projection, facts));
}

std::string to_json(const TrajectoryErrors& errors, const RpeSettings& settings, const TrajectoryErrorsFacts& facts,
                    const RelativeErrors& others) {
  Json json = common_json("rpe", errors, settings.alignment, settings.num_poses_to_align, settings.projection, facts);
  json["settings"]["delta"] = settings.pairs.delta;
  json["settings"]["delta_unit"] = name_of(settings.pairs.unit);
  json["settings"]["delta_tolerance"] = settings.pairs.relative_tolerance;
  json["settings"]["all_pairs"] = settings.pairs.all_pairs;
  json["settings"]["pairs_from_reference"] = settings.pairs_from_reference;
  json["num_zero_distances"] = errors.num_zero_distances;
  if (others.kitti_drift) json["kitti_drift"] = kitti_drift_json(*others.kitti_drift);
  if (!others.by_length.empty()) json["by_length"] = by_length_json(others.by_length);
  if (others.every_pair) {
    json["every_pair"] = {{"num_pairs", others.every_pair->translation_m.count},
                          {"translation_m", statistics_json(others.every_pair->translation_m)},
                          {"rotation_deg", statistics_json(internal::in_degrees(others.every_pair->rotation_rad))}};
  }
  if (others.paper_rpe_m2) json["paper_rpe_m2"] = *others.paper_rpe_m2;
  return internal::dump(json);
}

}  // namespace trysquare
