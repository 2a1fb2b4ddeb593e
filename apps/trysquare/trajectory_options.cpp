// SPDX-License-Identifier: Apache-2.0
#include "trajectory_options.h"

#include "trysquare/core/error.h"
#include "trysquare/io/calibration.h"
#include "trysquare/io/trajectory_file.h"
#include "trysquare/trajectory/axes_check.h"
#include "trysquare/trajectory/filters.h"
#include "trysquare/trajectory/hand_eye.h"

#include "input_options.h"
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace trysquare::app {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

std::optional<std::int64_t> nanoseconds(const char* option, const std::optional<double>& seconds) {
  constexpr double kLongest_s = 9e9;
  if (!seconds) return std::nullopt;
  if (!(std::abs(*seconds) <= kLongest_s))
    throw InvalidArgument(fmt::format("{} = {} is out of range", option, *seconds));
  return std::llround(*seconds * 1e9);
}

/// Downsampling and the motion filter come before the association, as in evo; the time range is the reference's.
void filter(const TrajectoryOptions& options, Trajectory& trajectory, const std::string& name, bool is_reference) {
  if (options.downsample) trajectory = downsampled(trajectory, *options.downsample);
  if (!options.motion_filter.empty()) {
    if (trajectory.stamps_ns.empty()) {
      throw InvalidArgument(name + ": --motion-filter needs time stamps: without them pose i belongs to pose i");
    }
    trajectory =
        motion_filtered(trajectory, options.motion_filter.at(0), options.motion_filter.at(1) * kRadiansPerDegree);
  }
  if (is_reference && (options.t_start_s || options.t_end_s)) {
    trajectory =
        in_time_range(trajectory, nanoseconds("--t-start", options.t_start_s), nanoseconds("--t-end", options.t_end_s));
  }
}

/// left · pose · right, and what takes a sensor's poses to those of its body.
void transform(const TrajectoryOptions& options, Trajectory& estimate) {
  const auto read = [](const std::string& spec) { return spec.empty() ? Pose{} : read_extrinsic(spec); };
  if (options.transform_left.empty() && options.transform_right.empty() && options.extrinsic.empty()) return;
  const Pose left = read(options.transform_left);
  const Pose right = read(options.transform_right) * general_inverse(read(options.extrinsic));
  for (Pose& pose : estimate.world_from_scan) pose = left * pose * right;
}

AssociatedTrajectories associate_files(const TrajectoryOptions& options, const Trajectory& reference,
                                       const Trajectory& estimate) {
  const bool by_time = !reference.stamps_ns.empty() && !estimate.stamps_ns.empty();
  if (!by_time && reference.size() != estimate.size()) {
    throw IoError(
        fmt::format("{}: {} poses, but {} has {}: without time stamps on both sides their numbers must be equal",
                    options.estimate, estimate.size(), options.reference, reference.size()));
  }
  options.association.validate();
  if (!by_time && (options.association.interpolate || options.association.one_to_one)) {
    throw InvalidArgument("--interpolate and --one-to-one need time stamps on both sides");
  }
  try {
    return associate(reference, estimate, options.association);
  } catch (const InvalidArgument& error) {  // the settings are fine: it is the files that have nothing in common
    throw IoError(fmt::format("{}: {}; see --t-offset and --t-max-diff", options.estimate, error.what()));
  }
}

void note_association(const TrajectoryOptions& options, const AssociatedTrajectories& poses) {
  if (poses.by_index) return;
  std::string text = fmt::format("{} pairs; unmatched: {} of the reference, {} of the estimate", poses.num_pairs,
                                 poses.num_unmatched_reference, poses.num_unmatched_estimate);
  if (poses.num_extrapolated > 0) text += fmt::format(" ({} outside the reference's time)", poses.num_extrapolated);
  if (poses.median_difference_s) text += fmt::format("; median time difference {:.3g} s", *poses.median_difference_s);
  options.common.note(text);
}

/// Finds where the sensor of the estimate sits on the body of the reference, and turns the estimate into the body's.
std::optional<HandEye> apply_hand_eye(const TrajectoryOptions& options, AssociatedTrajectories& poses) {
  if (!options.estimate_extrinsic) return std::nullopt;
  if (!options.extrinsic.empty()) throw InvalidArgument("--extrinsic and --estimate-extrinsic exclude each other");
  HandEye found;
  try {
    found = hand_eye(poses.reference, poses.estimate);
  } catch (const InvalidArgument& error) {
    throw IoError(fmt::format("{}: {}", options.estimate, error.what()));
  }
  const Pose sensor_from_body = rigid_inverse(found.body_from_sensor);
  for (Pose& pose : poses.estimate.world_from_scan) pose = pose * sensor_from_body;
  const Eigen::Vector3d& t = found.body_from_sensor.translation;
  options.common.note(
      fmt::format("the sensor sits at ({:.4f}, {:.4f}, {:.4f}) m on the body of the reference; motions fit "
                  "within {:.3g} m and {:.3g} degrees (rms)",
                  t.x(), t.y(), t.z(), found.translation_rms_m, found.rotation_rms_rad / kRadiansPerDegree));
  return found;
}

TrajectoryPreparation preparation_of(const TrajectoryOptions& options) {
  TrajectoryPreparation preparation{.association = options.association,
                                    .downsample = options.downsample,
                                    .t_start_s = options.t_start_s,
                                    .t_end_s = options.t_end_s,
                                    .transform_left = options.transform_left,
                                    .transform_right = options.transform_right,
                                    .extrinsic = options.estimate_extrinsic ? "estimated" : options.extrinsic};
  if (!options.motion_filter.empty()) {
    preparation.motion_filter_m_deg = {options.motion_filter.at(0), options.motion_filter.at(1)};
  }
  return preparation;
}

}  // namespace

Alignment TrajectoryOptions::alignment() const {
  if (align_origin && (align || correct_scale)) {
    throw InvalidArgument("--align-origin excludes --align and --correct-scale");
  }
  if (num_poses_to_align == 1 || num_poses_to_align == 2) {
    throw InvalidArgument(
        fmt::format("--n-to-align = {} is out of range: it must be 0 (all) or at least 3", num_poses_to_align));
  }
  if (align_origin) return Alignment::kOrigin;
  if (align) return correct_scale ? Alignment::kSim3 : Alignment::kSe3;
  return correct_scale ? Alignment::kScale : Alignment::kNone;
}

void add_trajectory_options(CLI::App& verb, TrajectoryOptions& options) {
  add_common_options(verb, options.common);
  add_json_option(verb, options.common);
  verb.add_option("REFERENCE", options.reference, "True trajectory: TUM, KITTI, EuRoC, matrices, ...")->required();
  verb.add_option("ESTIMATE", options.estimate, "Trajectory to be judged")->required();
  verb.add_option("--poses-format", options.format, "Format of both")
      ->check(CLI::IsMember(poses_formats()))
      ->capture_default_str();
  verb.add_option("-r,--pose-relation", options.relation, "What is compared; the ratio [%] is for rpe only")
      ->check(CLI::IsMember(
          {"full", "trans_part", "rot_part", "angle_deg", "angle_rad", "point_distance", "point_distance_error_ratio"}))
      ->capture_default_str();
  verb.add_flag("-a,--align", options.align, "Align by Umeyama's method");
  verb.add_flag("-s,--correct-scale", options.correct_scale, "Correct the scale by Umeyama's method");
  verb.add_flag("--align-origin", options.align_origin, "Let the first poses coincide");
  verb.add_option("--n-to-align", options.num_poses_to_align, "Align by the first n poses only; 0: all")
      ->capture_default_str();
  verb.add_option("--project-to-plane", options.plane, "Project both to a plane after the alignment")
      ->check(CLI::IsMember({"xy", "xz", "yz"}));
  verb.add_option("--change-unit", options.unit, "Unit of the errors")
      ->check(CLI::IsMember({"mm", "cm", "m", "km", "deg", "rad"}));
  verb.add_option("--quantiles", options.quantiles, "Shares whose quantiles the JSON has, as a comma list")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 1.0))
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->capture_default_str();
  const std::string times = "Which poses belong together";
  verb.add_option("--t-max-diff", options.association.max_difference_s, "Largest time difference of a pair [s]")
      ->capture_default_str()
      ->group(times);
  verb.add_option("--t-offset", options.association.offset_s, "Added to the time stamps of the estimate [s]")
      ->capture_default_str()
      ->group(times);
  verb.add_flag("--one-to-one", options.association.one_to_one, "No pose is in two pairs")->group(times);
  verb.add_flag("--interpolate", options.association.interpolate,
                "Interpolate the reference to the times of the estimate, rotations by SLERP")
      ->group(times);
  verb.add_option("--max-gap", options.association.max_gap_s,
                  "Do not interpolate between poses further apart than this [s]")
      ->capture_default_str()
      ->group(times);
  const std::string before = "What is done before";
  verb.add_option("--t-start", options.t_start_s, "Leave out what the reference has before this time [s]")
      ->group(before);
  verb.add_option("--t-end", options.t_end_s, "Leave out what the reference has after this time [s]")->group(before);
  verb.add_option("--downsample", options.downsample, "Keep at most n poses of each, evenly spread")->group(before);
  verb.add_option("--motion-filter", options.motion_filter,
                  "Keep poses that moved so many metres or turned so many degrees")
      ->expected(2)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(before);
  verb.add_option("--transform-left", options.transform_left,
                  "Multiply the estimate by this matrix from the left: a file, or 12 or 16 numbers in quotes")
      ->group(before);
  verb.add_option("--transform-right", options.transform_right, "The same from the right")->group(before);
  verb.add_option("--extrinsic", options.extrinsic,
                  "body_from_sensor, where the estimate is of a sensor and the reference of the body that carries it")
      ->group(before);
  verb.add_flag("--estimate-extrinsic", options.estimate_extrinsic,
                "Find that from the motions of both; they must turn about two axes")
      ->group(before);
}

TrajectoryPair load_trajectories(const TrajectoryOptions& options) {
  TrajectoryFile reference = read_trajectory(options.reference, format_option(options.format));
  TrajectoryFile estimate = read_trajectory(options.estimate, format_option(options.format));
  options.common.warn(reference.warnings);
  options.common.warn(estimate.warnings);
  filter(options, reference.trajectory, options.reference, true);
  filter(options, estimate.trajectory, options.estimate, false);
  transform(options, estimate.trajectory);
  TrajectoryPair pair{.poses = associate_files(options, reference.trajectory, estimate.trajectory)};
  note_association(options, pair.poses);
  pair.facts = {.version = TRYSQUARE_VERSION,
                .reference = options.reference,
                .estimate = options.estimate,
                .num_associated = pair.poses.num_pairs,
                .num_unmatched_reference = pair.poses.num_unmatched_reference,
                .num_unmatched_estimate = pair.poses.num_unmatched_estimate,
                .num_extrapolated = pair.poses.num_extrapolated,
                .median_time_difference_s = pair.poses.median_difference_s,
                .preparation = preparation_of(options),
                .quantiles = options.quantiles,
                .hand_eye = apply_hand_eye(options, pair.poses),
                .warnings = std::move(reference.warnings)};
  std::vector<Diagnostic>& warnings = pair.facts.warnings;
  warnings.insert(warnings.end(), estimate.warnings.begin(), estimate.warnings.end());
  if (const std::optional<Diagnostic> finding = check_axes(pair.poses.reference, pair.poses.estimate)) {
    options.common.warn({*finding});
    warnings.push_back(*finding);
  }
  return pair;
}

}  // namespace trysquare::app
