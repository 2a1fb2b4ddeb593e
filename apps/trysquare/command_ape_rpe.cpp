// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/io/trajectory_file.h"
#include "trysquare/report/trajectory_json.h"
#include "trysquare/trajectory/ape.h"
#include "trysquare/trajectory/association.h"
#include "trysquare/trajectory/rpe.h"

#include "commands.h"
#include "common_options.h"
#include "console.h"
#include "exit_codes.h"
#include "inputs.h"
#include "result_table.h"
#include <fmt/format.h>

#include <map>
#include <memory>
#include <utility>

namespace trysquare::app {
namespace {

constexpr const char* kApeFooter = R"(Examples:
  trysquare ape groundtruth.txt estimate.txt --align
  trysquare ape gt.txt orb.txt -as -r full --json -)";

constexpr const char* kRpeFooter = R"(Examples:
  trysquare rpe groundtruth.txt estimate.txt --delta 10 --delta_unit m --all_pairs
  trysquare rpe gt.txt orb.txt -r angle_deg -d 1 -u f --json -)";

/// Letters as in evo.
const std::map<std::string, DeltaUnit> kDeltaUnits = {
    {"f", DeltaUnit::kFrames}, {"m", DeltaUnit::kMetres}, {"d", DeltaUnit::kDegrees}, {"r", DeltaUnit::kRadians}};

struct ErrorOptions {
  CommonOptions common;
  std::string reference;
  std::string estimate;
  std::string format = "auto";
  std::string relation = "trans_part";
  bool align = false;
  bool correct_scale = false;
  bool align_origin = false;
  std::size_t num_poses_to_align = 0;
  AssociationSettings association;
  std::string delta_unit = "f";
  PosePairSettings pairs;
  bool pairs_from_reference = false;

  Alignment alignment() const {
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
};

AssociatedTrajectories load(const ErrorOptions& options) {
  const TrajectoryFile reference = read_trajectory(options.reference, format_option(options.format));
  const TrajectoryFile estimate = read_trajectory(options.estimate, format_option(options.format));
  options.common.warn(reference.warnings);
  options.common.warn(estimate.warnings);
  const bool by_time = !reference.trajectory.stamps_ns.empty() && !estimate.trajectory.stamps_ns.empty();
  if (!by_time && reference.trajectory.size() != estimate.trajectory.size()) {
    throw IoError(
        fmt::format("{}: {} poses, but {} has {}: without time stamps on both sides their numbers must be equal",
                    options.estimate, estimate.trajectory.size(), options.reference, reference.trajectory.size()));
  }
  options.association.validate();
  AssociatedTrajectories pairs;
  try {
    pairs = associate(reference.trajectory, estimate.trajectory, options.association);
  } catch (const InvalidArgument& error) {  // the settings are fine: it is the files that have nothing in common
    throw IoError(fmt::format("{}: {}; see --t-offset and --t-max-diff", options.estimate, error.what()));
  }
  if (by_time) {
    options.common.note(fmt::format("{} pairs; unmatched: {} of the reference, {} of the estimate", pairs.num_pairs,
                                    pairs.num_unmatched_reference, pairs.num_unmatched_estimate));
  }
  return pairs;
}

TrajectoryErrorsFacts facts_of(const ErrorOptions& options, const AssociatedTrajectories& pairs,
                               const std::string& reason) {
  return {.version = TRYSQUARE_VERSION,
          .reference = options.reference,
          .estimate = options.estimate,
          .num_associated = pairs.num_pairs,
          .num_unmatched_reference = pairs.num_unmatched_reference,
          .num_unmatched_estimate = pairs.num_unmatched_estimate,
          .reason = reason};
}

/// Errors, or why there are none.
struct Outcome {
  TrajectoryErrors errors;
  std::string reason;
};

/// Settings were checked before: what is refused now has no value, such as the alignment of a straight line.
template <class Compute>
Outcome errors_or_reason(PoseRelation relation, const Compute& compute) {
  try {
    return {compute(), ""};
  } catch (const InvalidArgument& error) {
    return {{.relation = relation}, error.what()};
  }
}

/// @param title  Of the table, without the number of errors.
void finish(const ErrorOptions& options, const std::string& title, const Outcome& outcome, const std::string& json) {
  if (options.common.prints_tables()) {
    fmt::print("{}", outcome.reason.empty() ? errors_table(title, outcome.errors)
                                            : fmt::format("{}\n\n  undefined: {}\n", title, outcome.reason));
  }
  write_json(options.common.json, json);
  if (!outcome.reason.empty()) throw NotMeaningful();
}

void run_ape(const ErrorOptions& options) {
  const AssociatedTrajectories pairs = load(options);
  const ApeSettings settings{.relation = *pose_relation_named(options.relation),
                             .alignment = options.alignment(),
                             .num_poses_to_align = options.num_poses_to_align};
  const Outcome outcome =
      errors_or_reason(settings.relation, [&] { return ape(pairs.reference, pairs.estimate, settings); });
  finish(options,
         fmt::format("APE {} ({} poses, alignment {})", options.relation, pairs.num_pairs, name_of(settings.alignment)),
         outcome, to_json(outcome.errors, settings, facts_of(options, pairs, outcome.reason)));
}

void run_rpe(const ErrorOptions& options) {
  const AssociatedTrajectories pairs = load(options);
  RpeSettings settings{.relation = *pose_relation_named(options.relation),
                       .pairs = options.pairs,
                       .pairs_from_reference = options.pairs_from_reference,
                       .alignment = options.alignment(),
                       .num_poses_to_align = options.num_poses_to_align};
  settings.pairs.unit = kDeltaUnits.at(options.delta_unit);
  settings.pairs.validate();
  const Outcome outcome =
      errors_or_reason(settings.relation, [&] { return rpe(pairs.reference, pairs.estimate, settings); });
  finish(options,
         fmt::format("RPE {} ({} pairs, delta {:g} {}{})", options.relation, outcome.errors.errors.size(),
                     options.pairs.delta, name_of(settings.pairs.unit), options.pairs.all_pairs ? ", all pairs" : ""),
         outcome, to_json(outcome.errors, settings, facts_of(options, pairs, outcome.reason)));
}

void add_error_options(CLI::App& verb, ErrorOptions& options) {
  add_common_options(verb, options.common);
  add_json_option(verb, options.common);
  verb.add_option("REFERENCE", options.reference, "True trajectory: TUM, KITTI, EuRoC, or matrices")->required();
  verb.add_option("ESTIMATE", options.estimate, "Trajectory to be judged")->required();
  verb.add_option("--poses-format", options.format, "Format of both")
      ->check(CLI::IsMember({"auto", "kitti", "tum", "euroc", "matrix"}))
      ->capture_default_str();
  verb.add_option("-r,--pose-relation", options.relation, "What is compared")
      ->check(CLI::IsMember({"full", "trans_part", "rot_part", "angle_deg", "angle_rad", "point_distance"}))
      ->capture_default_str();
  verb.add_flag("-a,--align", options.align, "Align by Umeyama's method");
  verb.add_flag("-s,--correct-scale", options.correct_scale, "Correct the scale by Umeyama's method");
  verb.add_flag("--align-origin", options.align_origin, "Let the first poses coincide");
  verb.add_option("--n-to-align", options.num_poses_to_align, "Align by the first n poses only; 0: all")
      ->capture_default_str();
  verb.add_option("--t-max-diff", options.association.max_difference_s, "Largest time difference of a pair [s]")
      ->capture_default_str();
  verb.add_option("--t-offset", options.association.offset_s, "Added to the time stamps of the estimate [s]")
      ->capture_default_str();
}

}  // namespace

void add_ape(CLI::App& app) {
  auto options = std::make_shared<ErrorOptions>();
  CLI::App& verb = *app.add_subcommand("ape", "Absolute pose error against a reference trajectory");
  verb.footer(kApeFooter);
  add_error_options(verb, *options);
  verb.callback([options] { run_ape(*options); });
}

void add_rpe(CLI::App& app) {
  auto options = std::make_shared<ErrorOptions>();
  CLI::App& verb = *app.add_subcommand("rpe", "Relative pose error against a reference trajectory");
  verb.footer(kRpeFooter);
  add_error_options(verb, *options);
  verb.add_option("-d,--delta", options->pairs.delta, "Distance of the two poses of a pair")->capture_default_str();
  verb.add_option("-u,--delta-unit", options->delta_unit, "f: frames, m: metres, d: degrees, r: radians")
      ->check(CLI::IsMember({"f", "m", "d", "r"}))
      ->capture_default_str();
  verb.add_option("--delta-tol", options->pairs.relative_tolerance,
                  "For all pairs by m, d, r: how far a pair may be off delta, relative")
      ->capture_default_str();
  verb.add_flag("--all-pairs", options->pairs.all_pairs, "All pairs, not consecutive ones only");
  verb.add_flag("--pairs-from-reference", options->pairs_from_reference,
                "Measure delta along the reference, not the estimate");
  verb.callback([options] { run_rpe(*options); });
}

}  // namespace trysquare::app
