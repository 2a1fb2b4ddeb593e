// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/diagnosis.h"

#include "trysquare/adjustment/adjust_poses.h"
#include "trysquare/adjustment/indexed_scans.h"
#include "trysquare/adjustment/patch_observations.h"
#include "trysquare/adjustment/plane_patches.h"
#include "trysquare/core/error.h"
#include "trysquare/pipeline/frame_check.h"
#include "trysquare/pipeline/handedness_check.h"
#include "trysquare/pipeline/sequence_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>

namespace trysquare {
namespace {

constexpr double kCoarse_m = 0.1;  ///< Halves that differ by more do not mean the same poses.
constexpr double kCoarse_rad = 0.5 * std::numbers::pi / 180;

double degrees(double rad) { return rad * 180 / std::numbers::pi; }

std::vector<Pose> poses_in_map(const Trajectory& trajectory) {
  const Pose map_from_world = general_inverse(trajectory.world_from_scan.front());
  std::vector<Pose> poses;
  for (const Pose& world_from_scan : trajectory.world_from_scan) poses.push_back(map_from_world * world_from_scan);
  return poses;
}

/// Stamps of the scans; those of their poses where the scans have none; empty where neither has.
std::vector<std::int64_t> stamps_of(const std::vector<ScanIdentity>& scans, const Trajectory& trajectory) {
  std::vector<std::int64_t> stamps_ns;
  for (const ScanIdentity& scan : scans) {
    if (!scan.stamp_ns) return trajectory.stamps_ns;
    stamps_ns.push_back(*scan.stamp_ns);
  }
  return stamps_ns;
}

bool ascend(const std::vector<std::int64_t>& stamps_ns) {
  return std::adjacent_find(stamps_ns.begin(), stamps_ns.end(), std::greater_equal<>()) == stamps_ns.end();
}

Finding finding_of(const FrameMistake& mistake) {
  return {.id = mistake.code,
          .severity = Severity::kError,
          .message = fmt::format("{}: with that corrected a neighborhood holds {:.1f} of {} scans on average, as given "
                                 "{:.1f}",
                                 mistake.mistake, mistake.scans_corrected, mistake.num_scans, mistake.scans_given),
          .remedy = mistake.remedy,
          .evidence = Evidence{mistake.scans_given, mistake.scans_corrected, "scans"}};
}

std::optional<Finding> low_overlap(const RpeEstimate& estimate) {
  const std::string remedy =
      "take scans that are nearer to each other, or check that the poses belong to these scans; without common "
      "surfaces "
      "no metric sees the poses";
  if (estimate.observations_per_pose_min < kFewestObservations) {
    return Finding{
        .id = "low_overlap",
        .severity = Severity::kError,
        .message = fmt::format("the scans share too few flat surfaces: one of them agrees with the others on {} "
                               "patches (limit {})",
                               estimate.observations_per_pose_min, kFewestObservations),
        .remedy = remedy,
        .evidence = Evidence{static_cast<double>(estimate.observations_per_pose_min),
                             static_cast<double>(kFewestObservations), "patches"}};
  }
  if (estimate.num_components <= 1) return std::nullopt;
  return Finding{.id = "low_overlap",
                 .severity = Severity::kError,
                 .message = fmt::format("the scans fall into {} groups that share too few flat surfaces (limit 1)",
                                        estimate.num_components),
                 .remedy = remedy,
                 .evidence = Evidence{static_cast<double>(estimate.num_components), 1, "groups"}};
}

std::optional<Finding> degenerate_direction(const RpeEstimate& estimate) {
  if (!estimate.weak_direction_in_map || estimate.observations_per_pose_min == 0) return std::nullopt;
  const Eigen::Vector3d& axis = *estimate.weak_direction_in_map;
  const bool is_blind = estimate.smallest_eigenvalue < kLeastEigenvalue;
  const double limit = is_blind ? kLeastEigenvalue : kWeakEigenvalue;
  return Finding{
      .id = "degenerate_direction",
      .severity = is_blind ? Severity::kError : Severity::kNote,
      .message = fmt::format("{} ({:.2f}, {:.2f}, {:.2f}) of the map: the smallest eigenvalue of the "
                             "normals is {:.4f} (limit {})",
                             is_blind ? "hardly any flat surface faces" : "few flat surfaces face", axis.x(), axis.y(),
                             axis.z(), estimate.smallest_eigenvalue, limit),
      .remedy = is_blind ? "do not trust what is said of positions along it; take scans that see surfaces across it"
                         : "positions along it are known less well than the others",
      .evidence = Evidence{estimate.smallest_eigenvalue, limit, ""}};
}

/// Whether nothing but the difference between the two halves of the patches speaks against an estimate, and a small
/// one. Where another rule is broken there is nothing of any pair.
bool is_only_coarse(const RpeEstimate& estimate) {
  return !estimate.by_pairs.empty() && estimate.half_difference_m.value_or(1) <= kCoarse_m &&
         estimate.half_difference_rad.value_or(1) <= kCoarse_rad;
}

/// An estimate that is refused for another reason than overlap and geometry.
std::optional<Finding> unclear_poses(const RpeEstimate& estimate) {
  if (estimate.status != EstimateStatus::kRefused) return std::nullopt;
  std::optional<Evidence> evidence;
  if (estimate.half_difference_m) {
    evidence = Evidence{*estimate.half_difference_m, half_difference_limit_m(estimate), "m"};
  }
  if (is_only_coarse(estimate)) {
    return Finding{
        .id = "poses_coarse",
        .severity = Severity::kNote,
        .message = fmt::format("the scans say where they stood, but not well enough to blame single poses: {}",
                               estimate.reasons.front()),
        .remedy = "take more scans, or scans with more points",
        .evidence = std::move(evidence)};
  }
  return Finding{.id = "poses_unclear",
                 .severity = Severity::kError,
                 .message = fmt::format("the scans do not say where they stood: {}", fmt::join(estimate.reasons, "; ")),
                 .remedy =
                     "the poses may be off by more than a metre, or belong to other scans, or much of the scene "
                     "moves: check the order of the poses and their frame, and look at the map",
                 .evidence = std::move(evidence)};
}

std::optional<Finding> time_finding(const TimeOffset& time) {
  if (!time.offset_s) return std::nullopt;
  const double given_m = time.costs[time.costs.size() / 2].error_m;
  return Finding{
      .id = "time_offset",
      .severity = Severity::kWarning,
      .message = fmt::format("each scan looks as if it belonged to the pose {:.0f} ms {} (resolution {:.0f} "
                             "ms): {:.1f} mm of error are left there, {:.0f} % of the {:.1f} mm as given "
                             "(limit 50 %)",
                             1000 * std::abs(*time.offset_s), *time.offset_s > 0 ? "later" : "earlier",
                             1000 * time.resolution_s.value_or(0), 1000 * time.best->error_m,
                             100 * time.best->error_m / given_m, 1000 * given_m),
      .remedy = fmt::format("check the clocks, and what of a scan its stamp means (begin, middle, end); take "
                            "the poses at the times of the scans {} {:.3f} s",
                            *time.offset_s > 0 ? "plus" : "minus", std::abs(*time.offset_s)),
      .evidence = Evidence{*time.offset_s, time.resolution_s.value_or(0), "s"}};
}

Finding finding_of(const SuspectPose& pose) {
  return {.id = "suspect_pose",
          .severity = Severity::kWarning,
          .message =
              fmt::format("pose {} is {:.3f} m ({:.3f} to {:.3f}) and {:.2f}° ({:.2f} to {:.2f}) off those around "
                          "it, {:.1f} times what is usual (limit {:g})",
                          pose.scan, pose.translation_m, pose.translation_interval_m[0], pose.translation_interval_m[1],
                          degrees(pose.rotation_rad), degrees(pose.rotation_interval_rad[0]),
                          degrees(pose.rotation_interval_rad[1]), pose.score, kSuspectScore),
          .remedy = "leave the scan out, register it again, or take the adjusted pose (trysquare refine)",
          .evidence = Evidence{pose.score, kSuspectScore, ""}};
}

Finding finding_of(const PoseGroup& group) {
  const std::string size = fmt::format("poses {} to {} are up to {:.3f} m and {:.2f}° off the others", group.first,
                                       group.last, group.translation_m, degrees(group.rotation_rad));
  if (group.is_drift) {
    return {.id = "pose_drift",
            .severity = Severity::kNote,
            .message = size + ", without a jump on either side",
            .remedy = "the trajectory drifts there; the adjusted poses (trysquare refine) do not",
            .evidence = {}};
  }
  return {
      .id = "pose_group",
      .severity = Severity::kWarning,
      .message = size + ", with a jump between",
      .remedy = "see what happened at the jump; register one side again, or take the adjusted poses (trysquare refine)",
      .evidence = {}};
}

Finding finding_of(const PoseJump& jump) {
  const bool by_translation = jump.translation_m > jump.limit_m;
  return {
      .id = "pose_jump",
      .severity = Severity::kWarning,
      .message = fmt::format("from scan {} to scan {} the poses jump against the scans by {:.3f} m (limit {:.3f}) and "
                             "{:.2f}° (limit {:.2f})",
                             jump.from, jump.from + 1, jump.translation_m, jump.limit_m, degrees(jump.rotation_rad),
                             degrees(jump.limit_rad)),
      .remedy = "see whether a scan is missing there and later poses belong to other scans, or a registration slipped",
      .evidence = by_translation ? Evidence{jump.translation_m, jump.limit_m, "m"}
                                 : Evidence{degrees(jump.rotation_rad), degrees(jump.limit_rad), "deg"}};
}

Finding finding_of(const PoseOffPath& pose) {
  return {
      .id = "pose_off_path",
      .severity = Severity::kWarning,
      .message = fmt::format("pose {} lies {:.2f} m beside the path of its neighbors (limit {:.2f}); the scans do not "
                             "say where it should be",
                             pose.scan, pose.distance_m, pose.limit_m),
      .remedy = "leave the scan out or register it again, and diagnose the rest",
      .evidence = Evidence{pose.distance_m, pose.limit_m, "m"}};
}

/// "3-7 9": ranges of ascending numbers.
std::string ranges(const std::vector<std::uint32_t>& scans) {
  std::string text;
  for (std::size_t i = 0; i < scans.size();) {
    std::size_t end = i + 1;
    while (end < scans.size() && scans[end] == scans[end - 1] + 1) ++end;
    if (!text.empty()) text += " ";
    text += end - i == 1 ? fmt::format("{}", scans[i]) : fmt::format("{}-{}", scans[i], scans[end - 1]);
    i = end;
  }
  return text;
}

Finding finding_of(const GhostWall& wall) {
  const Eigen::Vector3d& at = wall.center_in_map;
  const bool by_poses = wall.adjusted_m && *wall.adjusted_m < kShareThatPosesExplain * wall.distance_m;
  const std::string adjusted =
      wall.adjusted_m ? fmt::format(", {:.3f} m at the adjusted poses", *wall.adjusted_m) : std::string();
  return {
      .id = "ghost_wall",
      .severity = Severity::kWarning,
      .message = fmt::format("a surface at ({:.1f}, {:.1f}, {:.1f}) of the map is there twice, {:.3f} m apart (limit "
                             "{:.3f}){}: scans {} see the one, scans {} the other",
                             at.x(), at.y(), at.z(), wall.distance_m, wall.limit_m, adjusted, ranges(wall.lower_scans),
                             ranges(wall.upper_scans)),
      .remedy = !wall.adjusted_m ? "compare the poses of the two groups of scans, and the scene between them"
                : by_poses ? "the poses of one group of scans do it: register them again, or take the adjusted poses "
                             "(trysquare refine)"
                           : "no poses put it into one place: the scene changed in between (a door, a vehicle), or "
                             "the sensor did",
      .evidence = Evidence{wall.distance_m, wall.limit_m, "m"}};
}

std::vector<GhostWall> ghost_walls_of(const ScanSequence& scans, const Trajectory& trajectory,
                                      const Trajectory& adjusted, const AdjustmentSettings& settings,
                                      const Execution& execution) {
  const IndexedScans indexed(scans, settings, execution);
  const std::vector<PlanePatch> patches = find_plane_patches(indexed, settings, execution);
  const auto observe = [&](const Trajectory& from) {
    return observe_patches(patches, indexed, poses_in_map(from), settings.widest_half_height_m / 2, settings,
                           execution);
  };
  return find_ghost_walls(observe(trajectory), adjusted.size() == 0 ? std::vector<ObservedPatch>() : observe(adjusted));
}

/// The time offset, or why it is not judged.
TimeOffset time_offset_of(const Trajectory& trajectory, const std::vector<std::int64_t>& stamps_ns,
                          const Trajectory& adjusted, const DiagnosisSettings& settings,
                          const DiagnosisContext& context) {
  Trajectory poses = context.all_poses && !context.all_poses->stamps_ns.empty() ? *context.all_poses : trajectory;
  if (poses.stamps_ns.empty()) poses.stamps_ns = stamps_ns;
  TimeOffset none;
  if (stamps_ns.empty()) {
    none.reason = "neither scans nor poses have time stamps";
  } else if (adjusted.size() == 0) {
    none.reason = "there are no adjusted poses to compare with: the estimate is refused";
  } else if (!ascend(stamps_ns) || !ascend(poses.stamps_ns)) {
    none.reason = "the time stamps do not ascend";
  } else {
    return find_time_offset(poses, stamps_ns, adjusted, settings.max_time_offset_s);
  }
  return none;
}

/// Everything that only makes sense when frames and clocks are right.
void judge_poses(const ScanSequence& scans, const Trajectory& trajectory, const AdjustmentSettings& settings,
                 const Execution& execution, Diagnosis& result) {
  const RpeEstimate& estimate = *result.estimate;
  result.suspects = find_suspects(trajectory, estimate);
  result.jumps = find_jumps(trajectory, estimate, result.suspects.poses);
  if (estimate.adjusted.size() == 0) result.off_path = find_poses_off_path(trajectory);
  result.ghost_walls = ghost_walls_of(scans, trajectory, estimate.adjusted, settings, execution);
  for (const SuspectPose& suspect : result.suspects.poses) result.findings.push_back(finding_of(suspect));
  for (const PoseGroup& group : result.suspects.groups) {
    if (group.is_drift || result.jumps.empty()) result.findings.push_back(finding_of(group));  // else the jump says it
  }
  for (const PoseJump& jump : result.jumps) result.findings.push_back(finding_of(jump));
  for (const PoseOffPath& pose : result.off_path) result.findings.push_back(finding_of(pose));
  for (const GhostWall& wall : result.ghost_walls) result.findings.push_back(finding_of(wall));
}

/// Why single poses and walls would only echo a coarser mistake; empty: they would not.
std::string reason_against_blame(const std::vector<Finding>& findings) {
  for (const char* id :
       {"camera_frame", "extrinsic_not_needed", "extrinsic_inverted", "poses_inverted", "left_handed", "time_offset"}) {
    const bool is_found =
        std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) { return finding.id == id; });
    if (is_found) return fmt::format("not judged before {} is mended: everything would echo it", id);
  }
  return {};
}

/// Whether there is an error among the findings for every reason of a refusal.
bool is_explained_by(const std::vector<Finding>& findings, const std::vector<std::string>& reasons) {
  const auto num_errors = std::count_if(findings.begin(), findings.end(),
                                        [](const Finding& finding) { return finding.severity == Severity::kError; });
  return static_cast<std::size_t>(num_errors) >= reasons.size();
}

}  // namespace

void DiagnosisSettings::validate() const {
  const auto require_positive = [](double value, const char* name) {
    if (!(value > 0 && std::isfinite(value))) {
      throw InvalidArgument(fmt::format("{} = {} is out of range: it must be > 0", name, value));
    }
  };
  require_positive(radius_m, "radius_m");
  require_positive(max_time_offset_s, "max_time_offset_s");
  adjustment.validate();
}

Diagnosis diagnose(const ScanSequence& scans, const Trajectory& trajectory, const DiagnosisSettings& settings,
                   const DiagnosisContext& context, const Execution& execution) {
  settings.validate();
  require_pose_per_scan(trajectory, scans.size());
  Diagnosis result{.num_scans = scans.size()};
  if (scans.size() > 0) result.world_from_map = trajectory.world_from_scan.front();
  if (scans.size() < kFewestPosesOfEstimate) {
    result.reason = fmt::format("{} scan{}: too few to tell anything ({} are needed)", scans.size(),
                                scans.size() == 1 ? "" : "s", kFewestPosesOfEstimate);
    return result;
  }
  const auto add = [&](std::optional<Finding> finding) {
    if (finding) result.findings.push_back(std::move(*finding));
  };
  const std::vector<ScanIdentity> identities = identify_scans(scans, execution);
  const std::vector<std::int64_t> stamps_ns = stamps_of(identities, trajectory);
  if (const auto mistake =
          find_frame_mistake(scans, trajectory, context.body_from_sensor, settings.radius_m, execution)) {
    add(finding_of(*mistake));
  }
  add(check_duplicates(identities));
  add(check_gaps(identities, stamps_ns, trajectory));
  result.blame_reason = reason_against_blame(result.findings);

  if (result.blame_reason.empty()) {
    result.estimate = estimate_rpe(scans, trajectory, settings.adjustment, execution);
    const RpeEstimate& estimate = *result.estimate;
    if (estimate.num_patches == 0) {
      result.reason = "no scan has a flat surface that is large and near enough to judge by";
      return result;
    }
    add(low_overlap(estimate));
    add(degenerate_direction(estimate));
    if (!is_explained_by(result.findings, estimate.reasons)) add(unclear_poses(estimate));
    if (estimate.adjusted.size() > 0) add(check_handedness(trajectory, estimate.adjusted));
    result.blame_reason = reason_against_blame(result.findings);
  }
  result.time_offset.reason = result.blame_reason;
  if (result.blame_reason.empty()) {
    result.time_offset = time_offset_of(trajectory, stamps_ns, result.estimate->adjusted, settings, context);
    add(time_finding(result.time_offset));
    result.blame_reason = reason_against_blame(result.findings);
  }
  if (result.blame_reason.empty() && result.estimate->adjusted.size() == 0) {
    result.suspects_reason = "the estimate is refused: see its reasons";
  } else {
    result.suspects_reason = result.blame_reason;
  }
  if (result.blame_reason.empty()) judge_poses(scans, trajectory, settings.adjustment, execution, result);
  std::stable_sort(result.findings.begin(), result.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  return result;
}

}  // namespace trysquare
