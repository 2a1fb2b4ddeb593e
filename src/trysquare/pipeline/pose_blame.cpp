// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/pose_blame.h"

#include "trysquare/stats/median.h"
#include "trysquare/trajectory/rotation_angle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace trysquare {
namespace {

constexpr double kSigmas = 2;
constexpr double kHalves = 2;             ///< Half differences are root mean squares: single poses differ by more.
constexpr double kLeastSuspect_m = 0.01;  ///< The adjustment itself errs by 2 mm (streets) to 7 mm (KITTI).
constexpr double kLeastSuspect_rad = 0.1 * std::numbers::pi / 180;
constexpr double kLever_m = 10;
constexpr double kShareOfJump = 0.6;
constexpr std::size_t kFewestOfGroup = 3;
constexpr double kUsualSteps = 3.5;  ///< Chance alone: one of 10⁷ (5.4 standard deviations of one axis).
constexpr double kLeastJump_m = 0.03;
constexpr double kLeastJump_rad = 0.2 * std::numbers::pi / 180;
constexpr std::size_t kFewestSteps = 5;
constexpr double kUsualDistances = 10;
constexpr double kLeastOffPath_m = 0.3;
constexpr std::size_t kFewestPosesOfPath = 6;

std::array<double, 2> interval_around(double value, double sigma) {
  return {std::max(0.0, value - kSigmas * sigma), value + kSigmas * sigma};
}

/// The error of each step, as a relative pose.
std::vector<Pose> step_errors(const Trajectory& given, const Trajectory& adjusted) {
  std::vector<Pose> errors;
  for (std::size_t i = 0; i + 1 < given.size(); ++i) {
    const Pose should_be = rigid_inverse(adjusted.world_from_scan[i]) * adjusted.world_from_scan[i + 1];
    const Pose is = rigid_inverse(given.world_from_scan[i]) * given.world_from_scan[i + 1];
    errors.push_back(rigid_inverse(should_be) * is);
  }
  return errors;
}

/// Error as a length: a rotation as what it does at kLever_m.
double size_of(const SuspectPose& pose) { return std::hypot(pose.translation_m, kLever_m * pose.rotation_rad); }
double size_of(const Pose& error) {
  return std::hypot(error.translation.norm(), kLever_m * rotation_angle(error.rotation));
}

/// Suspects whose error is larger than what the estimate knows, in the order of the scans.
std::vector<SuspectPose> known_suspects(const RpeEstimate& estimate) {
  const double least_m = std::max(kLeastSuspect_m, kHalves * estimate.half_difference_m.value_or(0));
  const double least_rad = std::max(kLeastSuspect_rad, kHalves * estimate.half_difference_rad.value_or(0));
  std::vector<SuspectPose> suspects;
  for (std::size_t i = 0; i < estimate.poses.size(); ++i) {
    const EstimatedPose& pose = estimate.poses[i];
    const double translation_m = pose.deviation.error.translation_m.norm();
    const double rotation_rad = pose.deviation.error.rotation_rad.norm();
    const bool is_known = translation_m > std::max(least_m, kSigmas * pose.sigma_m) ||
                          rotation_rad > std::max(least_rad, kSigmas * pose.sigma_rad);
    if (!pose.deviation.suspect || !is_known) continue;
    suspects.push_back({.scan = i,
                        .translation_m = translation_m,
                        .rotation_rad = rotation_rad,
                        .translation_interval_m = interval_around(translation_m, pose.sigma_m),
                        .rotation_interval_rad = interval_around(rotation_rad, pose.sigma_rad),
                        .score = pose.deviation.score});
  }
  return suspects;
}

/// Whether `b` is the next pose after `a`, without a jump.
bool follows(const SuspectPose& a, const SuspectPose& b, const std::vector<Pose>& step_errors) {
  return b.scan == a.scan + 1 && size_of(step_errors[a.scan]) < kShareOfJump * std::max(size_of(a), size_of(b));
}

/// Whether a run of suspects begins or ends with a step that is off by a good part of its largest error.
bool has_jump(std::span<const SuspectPose> run, const std::vector<Pose>& step_errors) {
  double largest_m = 0;
  for (const SuspectPose& pose : run) largest_m = std::max(largest_m, size_of(pose));
  const std::size_t first = run.front().scan;
  const std::size_t last = run.back().scan;
  const bool begins = first > 0 && size_of(step_errors[first - 1]) >= kShareOfJump * largest_m;
  const bool ends = last < step_errors.size() && size_of(step_errors[last]) >= kShareOfJump * largest_m;
  return begins || ends;
}

PoseGroup group_of(std::span<const SuspectPose> run, bool is_drift) {
  PoseGroup group{.first = run.front().scan, .last = run.back().scan, .is_drift = is_drift};
  for (const SuspectPose& pose : run) {
    group.translation_m = std::max(group.translation_m, pose.translation_m);
    group.rotation_rad = std::max(group.rotation_rad, pose.rotation_rad);
  }
  return group;
}

/// Whether one of the two poses of a step is suspect and the poses beside it are not.
bool is_beside_single_suspect(std::size_t from, const std::vector<SuspectPose>& suspects) {
  const auto is_suspect = [&](std::size_t scan) {
    return std::any_of(suspects.begin(), suspects.end(), [&](const SuspectPose& each) { return each.scan == scan; });
  };
  const auto is_single = [&](std::size_t scan) {
    return is_suspect(scan) && !is_suspect(scan + 1) && (scan == 0 || !is_suspect(scan - 1));
  };
  return is_single(from) || is_single(from + 1);
}

}  // namespace

SuspectPoses find_suspects(const Trajectory& given, const RpeEstimate& estimate) {
  if (estimate.adjusted.size() != given.size()) return {};
  const std::vector<Pose> errors = step_errors(given, estimate.adjusted);
  const std::vector<SuspectPose> suspects = known_suspects(estimate);
  SuspectPoses result;
  for (std::size_t begin = 0, end = 0; begin < suspects.size(); begin = end) {
    end = begin + 1;
    while (end < suspects.size() && follows(suspects[end - 1], suspects[end], errors)) ++end;
    const std::span run = std::span(suspects).subspan(begin, end - begin);
    const bool is_drift = !has_jump(run, errors);
    if (run.size() >= kFewestOfGroup) {
      result.groups.push_back(group_of(run, is_drift));
    } else if (!is_drift) {
      result.poses.insert(result.poses.end(), run.begin(), run.end());
    }
  }
  std::stable_sort(result.poses.begin(), result.poses.end(),
                   [](const SuspectPose& a, const SuspectPose& b) { return size_of(a) > size_of(b); });
  return result;
}

std::vector<PoseJump> find_jumps(const Trajectory& given, const RpeEstimate& estimate,
                                 const std::vector<SuspectPose>& suspects) {
  if (estimate.adjusted.size() != given.size() || given.size() <= kFewestSteps) return {};
  std::vector<double> translations_m;
  std::vector<double> rotations_rad;
  for (const Pose& error : step_errors(given, estimate.adjusted)) {
    translations_m.push_back(error.translation.norm());
    rotations_rad.push_back(rotation_angle(error.rotation));
  }
  const auto limit_of = [](const std::vector<double>& sizes, double least, double half) {
    return std::max({kUsualSteps * median_of_defined(sizes).value_or(0), least, half});
  };
  const double limit_m = limit_of(translations_m, kLeastJump_m, kHalves * estimate.half_difference_m.value_or(0));
  const double limit_rad = limit_of(rotations_rad, kLeastJump_rad, kHalves * estimate.half_difference_rad.value_or(0));
  std::vector<PoseJump> jumps;
  for (std::size_t i = 0; i < translations_m.size(); ++i) {
    if (translations_m[i] <= limit_m && rotations_rad[i] <= limit_rad) continue;
    if (is_beside_single_suspect(i, suspects)) continue;
    jumps.push_back({.from = i,
                     .translation_m = translations_m[i],
                     .rotation_rad = rotations_rad[i],
                     .limit_m = limit_m,
                     .limit_rad = limit_rad});
  }
  return jumps;
}

std::vector<PoseOffPath> find_poses_off_path(const Trajectory& given) {
  if (given.size() < kFewestPosesOfPath) return {};
  std::vector<double> distances_m(given.size(), std::numeric_limits<double>::quiet_NaN());
  const auto position = [&](std::size_t i) { return given.world_from_scan[i].translation; };
  for (std::size_t i = 1; i + 1 < given.size(); ++i) {
    distances_m[i] = (position(i) - 0.5 * (position(i - 1) + position(i + 1))).norm();
  }
  const double limit_m = std::max(kUsualDistances * median_of_defined(distances_m).value_or(0), kLeastOffPath_m);
  std::vector<PoseOffPath> found;
  for (std::size_t i = 1; i + 1 < given.size(); ++i) {
    const bool is_farthest = !(distances_m[i] < distances_m[i - 1]) && !(distances_m[i] < distances_m[i + 1]);
    if (distances_m[i] > limit_m && is_farthest) {
      found.push_back({.scan = i, .distance_m = distances_m[i], .limit_m = limit_m});
    }
  }
  return found;
}

}  // namespace trysquare
