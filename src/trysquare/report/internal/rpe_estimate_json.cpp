// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/rpe_estimate_json.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>

namespace trysquare::internal {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr const char* kRefused = "the estimate is refused: see reasons";
constexpr const char* kNoInliers = "no pose agrees with a patch";
constexpr const char* kNoHalves = "there are no two halves of the patches";

std::optional<double> scaled(const std::optional<double>& value, double factor) {
  return value ? std::optional(*value * factor) : std::nullopt;
}

void set_interval(Json& json, const std::string& key, const std::optional<std::array<double, 2>>& interval,
                  double factor, const std::string& reason) {
  if (interval) {
    json[key] = {number_or_null((*interval)[0] * factor), number_or_null((*interval)[1] * factor)};
    return;
  }
  json[key] = nullptr;
  json[key + "_reason"] = reason;
}

Json observability_json(const RpeEstimate& estimate, bool was_adjusted) {
  Json json;
  set_or_explain(json, "smallest_eigenvalue", was_adjusted ? std::optional(estimate.smallest_eigenvalue) : std::nullopt,
                 "nothing was adjusted");
  if (estimate.weak_direction_in_map) {
    json["weak_direction"] = array_of(*estimate.weak_direction_in_map);
  } else {
    json["weak_direction"] = nullptr;
    json["weak_direction_reason"] = was_adjusted ? "no direction is weak" : "nothing was adjusted";
  }
  if (const std::optional<PoseTie>& tie = estimate.weakest_tie) {
    json["weakest_tie"] = {{"eigenvalue", number_or_null(tie->eigenvalue)},
                           {"limit", number_or_null(tie->limit)},
                           {"first_pose", tie->first_pose},
                           {"last_pose", tie->last_pose},
                           {"direction", array_of(tie->direction_in_map)}};
  } else {
    json["weakest_tie"] = nullptr;
    json["weakest_tie_reason"] = was_adjusted ? kNoInliers : "nothing was adjusted";
  }
  return json;
}

/// Of a value that only a measurement or only a bound has.
std::string other_status_reason(EstimateStatus status, EstimateStatus wanted, const std::string& refused) {
  if (status == EstimateStatus::kRefused) return refused;
  std::string reason = "only a ";
  reason += wanted == EstimateStatus::kMeasured ? "measured estimate" : "bound";
  reason += " has one";
  return reason;
}

Json pairs_json(const PairRpe& rpe) {
  Json json = {{"delta", rpe.pairs.delta},
               {"unit", name_of(rpe.pairs.unit)},
               {"num_pairs", rpe.num_pairs},
               {"status", name_of(rpe.status)}};
  const std::string reason =
      rpe.num_pairs == 0 ? "no pair of poses is that far apart" : "the halves differ by too much over these pairs";
  const std::string no_halves = rpe.num_pairs == 0 ? reason : kNoHalves;
  set_or_explain(json, "translation_rms_m", rpe.translation_rms_m, reason);
  set_or_explain(json, "rotation_rms_deg", scaled(rpe.rotation_rms_rad, kDegrees), reason);
  set_interval(json, "interval_m", rpe.interval_m, 1,
               other_status_reason(rpe.status, EstimateStatus::kMeasured, reason));
  set_or_explain(json, "upper_bound_m", rpe.upper_bound_m,
                 other_status_reason(rpe.status, EstimateStatus::kBound, reason));
  set_or_explain(json, "half_difference_m", rpe.half_difference_m, no_halves);
  set_or_explain(json, "half_difference_deg", scaled(rpe.half_difference_rad, kDegrees), no_halves);
  return json;
}

Json pose_json(std::size_t index, const EstimatedPose& pose) {
  return {{"index", index},
          {"translation_error_m", array_of(pose.deviation.error.translation_m)},
          {"rotation_error_deg", array_of(kDegrees * pose.deviation.error.rotation_rad)},
          {"sigma_m", number_or_null(pose.sigma_m)},
          {"sigma_deg", number_or_null(pose.sigma_rad * kDegrees)},
          {"num_observations", pose.num_observations},
          {"score", number_or_null(pose.deviation.score)},
          {"suspect", pose.deviation.suspect}};
}

}  // namespace

Json rpe_estimate_json(const RpeEstimate& estimate) {
  const bool was_adjusted = estimate.num_iterations > 0;
  const std::string no_interval = other_status_reason(estimate.status, EstimateStatus::kMeasured, kRefused);
  Json json = {{"status", name_of(estimate.status)}, {"reasons", estimate.reasons}};
  set_or_explain(json, "translation_rms_m", estimate.translation_rms_m, kRefused);
  set_or_explain(json, "rotation_rms_deg", scaled(estimate.rotation_rms_rad, kDegrees), kRefused);
  set_interval(json, "interval_m", estimate.interval_m, 1, no_interval);
  set_interval(json, "interval_deg", estimate.interval_rad, kDegrees, no_interval);
  json["interval_covers"] = kIntervalCovers;
  set_or_explain(json, "upper_bound_m", estimate.upper_bound_m,
                 other_status_reason(estimate.status, EstimateStatus::kBound, kRefused));
  set_or_explain(json, "half_difference_m", estimate.half_difference_m, kNoHalves);
  set_or_explain(json, "half_difference_deg", scaled(estimate.half_difference_rad, kDegrees), kNoHalves);
  const std::string no_step = "nothing was adjusted";
  set_or_explain(json, "last_step_m", was_adjusted ? std::optional(estimate.last_step_m) : std::nullopt, no_step);
  set_or_explain(json, "last_step_deg", was_adjusted ? std::optional(estimate.last_step_rad * kDegrees) : std::nullopt,
                 no_step);
  json["num_iterations"] = estimate.num_iterations;
  set_or_explain(json, "systematic_indicator_m", estimate.systematic_indicator_m,
                 estimate.systematic_reason.empty() ? kRefused : estimate.systematic_reason);
  set_or_explain(json, "mom_debiased_m", estimate.between_scans.mom_debiased_m,
                 "fewer than three orthogonal directions");
  json["num_patches"] = estimate.num_patches;
  json["observations_per_pose_min"] = estimate.observations_per_pose_min;
  set_or_explain(json, "least_share_of_neighbors", estimate.least_share_of_neighbors,
                 was_adjusted ? kNoInliers : no_step);
  json["num_components"] = estimate.num_components;
  json["within_scan_sigma_m"] = number_or_null(estimate.within_scan_sigma_m);
  json["observability"] = observability_json(estimate, was_adjusted);
  json["by_pairs"] = Json::array();
  for (const PairRpe& rpe : estimate.by_pairs) json["by_pairs"].push_back(pairs_json(rpe));
  json["poses"] = Json::array();
  for (std::size_t i = 0; i < estimate.poses.size(); ++i) json["poses"].push_back(pose_json(i, estimate.poses[i]));
  return json;
}

Json adjustment_settings_json(const AdjustmentSettings& settings) {
  return {{"patch_radius_m", settings.patch_radius_m},
          {"patch_spacing_m", settings.patch_spacing_m},
          {"max_thickness_m", settings.max_thickness_m},
          {"planarity_ratio", settings.planarity_ratio},
          {"min_patch_range_m", settings.min_patch_range_m},
          {"max_patch_range_m", settings.max_patch_range_m},
          {"scans_per_source", settings.scans_per_source},
          {"max_patches_per_source", settings.max_patches_per_source},
          {"max_observation_range_m", settings.max_observation_range_m},
          {"max_observers", settings.max_observers},
          {"widest_half_height_m", settings.widest_half_height_m},
          {"narrowest_half_height_m", settings.narrowest_half_height_m},
          {"max_iterations", settings.max_iterations},
          {"checkerboard_m", settings.checkerboard_m},
          {"covariance_block_m", settings.covariance_block_m}};
}

}  // namespace trysquare::internal
