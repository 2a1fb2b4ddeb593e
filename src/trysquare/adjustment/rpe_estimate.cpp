// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/rpe_estimate.h"

#include "trysquare/adjustment/adjust_poses.h"
#include "trysquare/adjustment/indexed_scans.h"
#include "trysquare/adjustment/internal/agreement.h"
#include "trysquare/adjustment/plane_patches.h"
#include "trysquare/core/error.h"
#include "trysquare/trajectory/all_pairs_rpe.h"
#include "trysquare/trajectory/rotation_angle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace trysquare {
namespace {

using internal::Agreement;
using internal::agreement_of;

// The rest of the seven rules of docs/definitions.md#rpe-estimate.
constexpr double kLeastShareOfNeighbors = 0.4;
constexpr double kHalfShare = 0.2;
constexpr double kHalfOfBound_m = 0.02;
constexpr double kHalfOfBoundInSigmas = 1.5;
constexpr double kHalfOfBound_rad = 0.1 * std::numbers::pi / 180;
// The interval.
constexpr double kPairSigmas = 1.5;
constexpr double kRotationSigmas = 2.5;

double degrees(double rad) { return rad * 180 / std::numbers::pi; }

/// Root of a mean square less the part that is noise. A mean square below its noise is 0.
double without_noise(double rms, double noise) { return std::sqrt(std::max(0.0, rms * rms - noise)); }

Trajectory trajectory_of(std::vector<Pose> poses) { return {.world_from_scan = std::move(poses)}; }

/// Poses in the frame of the first, with the general inverse, as the map is assembled.
std::vector<Pose> poses_in_map(const Trajectory& trajectory) {
  std::vector<Pose> map_from_scan;
  const Pose map_from_world = general_inverse(trajectory.world_from_scan.front());
  for (const Pose& world_from_scan : trajectory.world_from_scan) {
    map_from_scan.push_back(map_from_world * world_from_scan);
  }
  return map_from_scan;
}

/// Everything that stays the same while parts of the patches are adjusted.
struct Problem {
  const IndexedScans& scans;
  const std::vector<Pose>& given;
  const AdjustmentSettings& settings;
  const Execution& execution;

  AdjustedPoses adjust(std::span<const PlanePatch> patches, std::span<const Pose> from) const {
    return adjust_poses(patches, scans, from, settings, execution);
  }
};

/// The patches for which `is_first(patch)` holds, and the others.
template <class IsFirst>
std::array<std::vector<PlanePatch>, 2> split(std::span<const PlanePatch> patches, const IsFirst& is_first) {
  std::array<std::vector<PlanePatch>, 2> parts;
  for (const PlanePatch& patch : patches) parts[is_first(patch) ? 0 : 1].push_back(patch);
  return parts;
}

AllPairsRpe difference(const AdjustedPoses& a, const AdjustedPoses& b) {
  return all_pairs_rpe(trajectory_of(a.map_from_scan), trajectory_of(b.map_from_scan));
}

/// Two halves of the patches, the colors of a checkerboard in the map, adjusted from the given poses; none if one is
/// empty.
std::vector<Trajectory> halves_of(std::span<const PlanePatch> patches, const Problem& problem) {
  const auto is_white = [&](const PlanePatch& patch) {
    const Eigen::Vector3d field =
        ((problem.given[patch.scan] * patch.center_in_scan) / problem.settings.checkerboard_m).array().floor();
    return std::fmod(std::abs(field.sum()), 2) < 0.5;
  };
  const auto [white, black] = split(patches, is_white);
  if (white.empty() || black.empty()) return {};
  return {trajectory_of(problem.adjust(white, problem.given).map_from_scan),
          trajectory_of(problem.adjust(black, problem.given).map_from_scan)};
}

/// Near and far patches alone, adjusted from the adjusted poses: what the sensor's calibration and motion bend.
void compare_near_with_far(std::span<const PlanePatch> patches, const std::vector<Pose>& adjusted,
                           const Problem& problem, RpeEstimate& result) {
  std::vector<double> ranges_m;
  for (const PlanePatch& patch : patches) ranges_m.push_back(patch.center_in_scan.norm());
  const auto middle = ranges_m.begin() + static_cast<std::ptrdiff_t>(ranges_m.size() / 2);
  std::nth_element(ranges_m.begin(), middle, ranges_m.end());
  const auto [near, far] =
      split(patches, [&](const PlanePatch& patch) { return patch.center_in_scan.norm() < *middle; });
  const AdjustedPoses by_near = problem.adjust(near, adjusted);
  const AdjustedPoses by_far = problem.adjust(far, adjusted);
  for (const AdjustedPoses* part : {&by_near, &by_far}) {
    if (agreement_of(*part, adjusted.size()).observations_per_pose_min >= kFewestObservations && part->converged) {
      continue;
    }
    result.systematic_reason =
        fmt::format("the {} patches alone do not fix the poses", part == &by_near ? "near" : "far");
    return;
  }
  result.systematic_indicator_m = difference(by_near, by_far).translation_m.rmse;
}

/// All rules but that of the halves: what must hold before any number means anything.
void apply_first_rules(const Agreement& agreement, const AdjustedPoses& adjusted, std::vector<std::string>& reasons) {
  if (agreement.observations_per_pose_min < kFewestObservations) {
    reasons.push_back(fmt::format("pose {} is measured on {} patches only ({} are needed)",
                                  agreement.least_observed_pose, agreement.observations_per_pose_min,
                                  kFewestObservations));
  }
  if (agreement.least_share_of_neighbors < kLeastShareOfNeighbors) {
    reasons.push_back(fmt::format(
        "pose {} agrees with {:.0f} % of the patches that the poses around it agree with only "
        "({:.0f} % are needed)",
        agreement.least_agreeing_pose, 100 * agreement.least_share_of_neighbors, 100 * kLeastShareOfNeighbors));
  }
  if (agreement.num_components > 1) {
    reasons.push_back(fmt::format("the scans fall into {} groups that share fewer than {} patches with each other",
                                  agreement.num_components, internal::kFewestSharedPatches));
  }
  if (!adjusted.converged) {
    reasons.push_back(
        fmt::format("the adjustment did not converge: after {} iterations a step is {:.1f} mm and {:.3f} deg "
                    "({:.0f} mm and {:.2f} deg are the limits)",
                    adjusted.num_iterations, 1000 * adjusted.last_step_m, degrees(adjusted.last_step_rad),
                    1000 * kConvergedStep_m, degrees(kConvergedStep_rad)));
  }
  if (agreement.smallest_eigenvalue < kLeastEigenvalue) {
    const Eigen::Vector3d& weak = agreement.weakest_direction_in_map;
    reasons.push_back(
        fmt::format("hardly any plane faces the direction ({:.2f}, {:.2f}, {:.2f}) of the map: the smallest "
                    "eigenvalue of the normals is {:.4f} ({} is needed)",
                    weak.x(), weak.y(), weak.z(), agreement.smallest_eigenvalue, kLeastEigenvalue));
  } else if (agreement.weakest_tie && agreement.weakest_tie->eigenvalue < agreement.weakest_tie->limit) {
    const PoseTie& tie = *agreement.weakest_tie;
    reasons.push_back(fmt::format(
        "poses {} to {} fall into groups that share hardly any plane across the direction ({:.2f}, {:.2f}, {:.2f}) of "
        "the map, and slide along it: the smallest eigenvalue of the planes that they share is {:.4f} ({:.4f} is "
        "needed)",
        tie.first_pose, tie.last_pose, tie.direction_in_map.x(), tie.direction_in_map.y(), tie.direction_in_map.z(),
        tie.eigenvalue, tie.limit));
  }
}

/// Root mean squares over some pairs of poses.
struct PairRms {
  double translation_m = 0;
  double rotation_rad = 0;
};

/// Rule 5: two halves of the patches must agree, relative to the estimate or absolutely.
EstimateStatus status_by_halves(const PairRms& half, const PairRms& estimate, double limit_m) {
  const bool agrees = half.translation_m <= kHalfShare * estimate.translation_m &&
                      half.rotation_rad <= std::max(kHalfShare * estimate.rotation_rad, kHalfOfBound_rad);
  if (agrees) return EstimateStatus::kMeasured;
  const bool is_small = half.translation_m <= limit_m && half.rotation_rad <= kHalfOfBound_rad;
  return is_small ? EstimateStatus::kBound : EstimateStatus::kRefused;
}

/// The status of all pairs, and why.
EstimateStatus judge_all_pairs(const RpeEstimate& result, std::vector<std::string>& reasons) {
  if (!result.half_difference_m) {
    reasons.emplace_back("the patches cannot be divided into two halves that check each other");
    return EstimateStatus::kRefused;
  }
  const PairRms half{*result.half_difference_m, *result.half_difference_rad};
  const PairRms estimate{*result.translation_rms_m, *result.rotation_rms_rad};
  const double limit_m = half_difference_limit_m(result);
  const EstimateStatus status = status_by_halves(half, estimate, limit_m);
  if (status == EstimateStatus::kMeasured) return status;
  reasons.push_back(fmt::format(
      "two halves of the patches differ by {:.1f} mm and {:.3f} deg, the estimate is {:.1f} mm and {:.3f} deg ({})",
      1000 * half.translation_m, degrees(half.rotation_rad), 1000 * estimate.translation_m,
      degrees(estimate.rotation_rad),
      status == EstimateStatus::kBound ? "too small to measure, but bounded"
                                       : fmt::format("{:.0f} % of it, or {:.0f} mm and {:.1f} deg, are the limits",
                                                     100 * kHalfShare, 1000 * limit_m, degrees(kHalfOfBound_rad))));
  return status;
}

/// Of the relative pose errors of these pairs, of which there is one at least.
PairRms rms_over(const std::vector<PosePair>& pairs, const Trajectory& reference, const Trajectory& estimate) {
  const auto relative = [](const Trajectory& trajectory, const PosePair& pair) {
    return rigid_inverse(trajectory.world_from_scan[pair.first]) * trajectory.world_from_scan[pair.second];
  };
  double translation_m2 = 0;
  double rotation_rad2 = 0;
  for (const PosePair& pair : pairs) {
    const Pose error = rigid_inverse(relative(reference, pair)) * relative(estimate, pair);
    translation_m2 += error.translation.squaredNorm();
    rotation_rad2 += std::pow(rotation_angle(error.rotation), 2);
  }
  const auto num_pairs = static_cast<double>(pairs.size());
  return {std::sqrt(translation_m2 / num_pairs), std::sqrt(rotation_rad2 / num_pairs)};
}

/// How far an interval reaches: by the noise of its pairs, or by half the difference of the halves; a bound by all of
/// it.
double reach_of(EstimateStatus status, double pair_sigma_m, double half_m) {
  return status == EstimateStatus::kBound ? half_m : std::max(kPairSigmas * pair_sigma_m, half_m / 2);
}

std::array<double, 2> interval_around(double value, double reach) {
  return {std::max(0.0, value - reach), value + reach};
}

std::vector<PosePairSettings> pairs_to_report() {
  return {{.delta = 1, .unit = DeltaUnit::kFrames, .all_pairs = true},
          {.delta = 10, .unit = DeltaUnit::kFrames, .all_pairs = true},
          {.delta = 10, .unit = DeltaUnit::kMetres, .all_pairs = true}};
}

/// The errors of some pairs, judged by their own halves.
void estimate_pairs(const std::vector<PosePair>& chosen, const PairVariance& noise, const Trajectory& corrected,
                    const Trajectory& given, const std::vector<Trajectory>& halves, double limit_m, PairRpe& result) {
  if (halves.empty()) return;
  const PairRms half = rms_over(chosen, halves[0], halves[1]);
  result.half_difference_m = half.translation_m;
  result.half_difference_rad = half.rotation_rad;
  PairRms rms = rms_over(chosen, corrected, given);
  rms = {without_noise(rms.translation_m, noise.translation_m2), without_noise(rms.rotation_rad, noise.rotation_rad2)};
  result.status = status_by_halves(half, rms, limit_m);
  if (result.status == EstimateStatus::kRefused) return;
  result.translation_rms_m = rms.translation_m;
  result.rotation_rms_rad = rms.rotation_rad;
  const double reach_m = reach_of(result.status, std::sqrt(noise.translation_m2), half.translation_m);
  if (result.status == EstimateStatus::kBound) {
    result.upper_bound_m = rms.translation_m + reach_m;
  } else {
    result.interval_m = interval_around(rms.translation_m, reach_m);
  }
}

void estimate_errors(const AdjustedPoses& adjusted, const Problem& problem, const std::vector<Trajectory>& halves,
                     RpeEstimate& result, PoseErrorCovariance& covariance) {
  const Trajectory given = trajectory_of(problem.given);
  const Trajectory corrected = trajectory_of(adjusted.map_from_scan);
  std::vector<std::vector<PosePair>> pair_sets;
  for (const PosePairSettings& pairs : pairs_to_report()) {
    result.by_pairs.push_back({.pairs = pairs});
    if (pairs.unit == DeltaUnit::kFrames && pairs.delta >= static_cast<double>(given.size())) continue;
    std::vector<PosePair> chosen = pose_pairs(given, pairs);
    result.by_pairs.back().num_pairs = chosen.size();
    if (!chosen.empty()) pair_sets.push_back(std::move(chosen));
  }
  covariance = pose_error_covariance(adjusted.observed, adjusted.observed_from, adjusted.errors,
                                     problem.settings.covariance_block_m, pair_sets, problem.execution);
  const AllPairsRpe all = all_pairs_rpe(corrected, given);
  result.translation_rms_m = without_noise(all.translation_m.rmse, covariance.all_pairs.translation_m2);
  result.rotation_rms_rad = without_noise(all.rotation_rad.rmse, covariance.all_pairs.rotation_rad2);
  result.pair_sigma_m = std::sqrt(covariance.all_pairs.translation_m2);
  result.pair_sigma_rad = std::sqrt(covariance.all_pairs.rotation_rad2);
  std::size_t set = 0;
  for (PairRpe& each : result.by_pairs) {
    if (each.num_pairs == 0) continue;
    estimate_pairs(pair_sets[set], covariance.of_pairs[set], corrected, given, halves, half_difference_limit_m(result),
                   each);
    ++set;
  }
}

void describe_poses(const AdjustedPoses& adjusted, const Agreement& agreement, const PoseErrorCovariance& covariance,
                    const Trajectory& trajectory, const std::vector<Pose>& given, RpeEstimate& result) {
  const std::vector<PoseDeviation> deviations = deviations_of_poses(given, adjusted.map_from_scan);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Eigen::Matrix<double, 6, 1> variances = covariance.of_pose[i].diagonal();
    result.poses.push_back({.deviation = deviations[i],
                            .sigma_m = std::sqrt(variances.head<3>().sum()),
                            .sigma_rad = std::sqrt(variances.tail<3>().sum()),
                            .num_observations = agreement.observations_of_pose[i]});
  }
  result.adjusted.stamps_ns = trajectory.stamps_ns;
  for (const Pose& map_from_scan : adjusted.map_from_scan) {
    result.adjusted.world_from_scan.push_back(trajectory.world_from_scan.front() * map_from_scan);
  }
}

/// A refusal has no numbers but those that say why, and those of near pairs whose halves agree to the noise: then they
/// drift. Halves that differ by more between near poses stand at wrong places, and may do so together.
void take_back(RpeEstimate& result) {
  const double limit_m = half_difference_limit_m(result);
  for (PairRpe& each : result.by_pairs) {
    if (each.half_difference_m.value_or(0) <= limit_m && each.half_difference_rad.value_or(0) <= kHalfOfBound_rad) {
      continue;
    }
    each = {.pairs = each.pairs,
            .num_pairs = each.num_pairs,
            .half_difference_m = each.half_difference_m,
            .half_difference_rad = each.half_difference_rad};
  }
  result.translation_rms_m.reset();
  result.rotation_rms_rad.reset();
  result.pair_sigma_m = 0;
  result.pair_sigma_rad = 0;
}

}  // namespace

std::string_view name_of(EstimateStatus status) {
  switch (status) {
    case EstimateStatus::kMeasured:
      return "measured";
    case EstimateStatus::kBound:
      return "bound";
    case EstimateStatus::kRefused:
      break;
  }
  return "refused";
}

double half_difference_limit_m(const RpeEstimate& estimate) {
  return std::max(kHalfOfBound_m, kHalfOfBoundInSigmas * estimate.within_scan_sigma_m);
}

double interval_reach_m(const RpeEstimate& estimate) {
  if (estimate.status == EstimateStatus::kRefused) throw InvalidArgument("a refused estimate has no interval");
  return reach_of(estimate.status, estimate.pair_sigma_m, *estimate.half_difference_m);
}

RpeEstimate estimate_rpe(const ScanSequence& scans, const Trajectory& trajectory, const AdjustmentSettings& settings,
                         const Execution& execution) {
  settings.validate();
  execution.validate();
  require_pose_per_scan(trajectory, scans.size());
  RpeEstimate result;
  if (trajectory.size() < kFewestPosesOfEstimate) {
    result.reasons.push_back(fmt::format("{} poses: a single pair offers no check of itself ({} are needed)",
                                         trajectory.size(), kFewestPosesOfEstimate));
    return result;
  }
  const std::vector<Pose> given = poses_in_map(trajectory);
  const IndexedScans indexed(scans, settings, execution);
  const std::vector<PlanePatch> patches = find_plane_patches(indexed, settings, execution);
  result.num_patches = patches.size();
  const Problem problem{.scans = indexed, .given = given, .settings = settings, .execution = execution};

  // The whole, and whether it means anything.
  const AdjustedPoses adjusted = problem.adjust(patches, given);
  const Agreement agreement = agreement_of(adjusted, given.size());
  result.observations_per_pose_min = agreement.observations_per_pose_min;
  if (agreement.num_inliers > 0) result.least_share_of_neighbors = agreement.least_share_of_neighbors;
  result.num_components = agreement.num_components;
  result.num_iterations = adjusted.num_iterations;
  result.last_step_m = adjusted.last_step_m;
  result.last_step_rad = adjusted.last_step_rad;
  result.smallest_eigenvalue = agreement.smallest_eigenvalue;
  if (agreement.smallest_eigenvalue < kWeakEigenvalue) {
    result.weak_direction_in_map = agreement.weakest_direction_in_map;
  }
  result.weakest_tie = agreement.weakest_tie;
  result.within_scan_sigma_m = agreement.within_scan_sigma_m;
  result.between_scans = between_scan_variance(
      observe_patches(patches, indexed, given, settings.widest_half_height_m / 2, settings, execution));
  apply_first_rules(agreement, adjusted, result.reasons);

  // Two halves, which must agree.
  const std::vector<Trajectory> halves = halves_of(patches, problem);
  if (!halves.empty()) {
    const AllPairsRpe half = all_pairs_rpe(halves[0], halves[1]);
    result.half_difference_m = half.translation_m.rmse;
    result.half_difference_rad = half.rotation_rad.rmse;
  }
  PoseErrorCovariance covariance;
  if (agreement.num_inliers > 0) estimate_errors(adjusted, problem, halves, result, covariance);
  if (result.reasons.empty()) {
    result.status = judge_all_pairs(result, result.reasons);
  } else {
    result.by_pairs.clear();
  }
  if (result.status == EstimateStatus::kRefused) {
    take_back(result);
    return result;
  }

  const double reach_m = interval_reach_m(result);
  if (result.status == EstimateStatus::kBound) {
    result.upper_bound_m = *result.translation_rms_m + reach_m;
  } else {
    result.interval_m = interval_around(*result.translation_rms_m, reach_m);
    result.interval_rad = interval_around(*result.rotation_rms_rad, kRotationSigmas * result.pair_sigma_rad);
  }
  compare_near_with_far(patches, adjusted.map_from_scan, problem, result);
  describe_poses(adjusted, agreement, covariance, trajectory, given, result);
  return result;
}

}  // namespace trysquare
