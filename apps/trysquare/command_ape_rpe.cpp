// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/report/trajectory_json.h"
#include "trysquare/trajectory/all_pairs_rpe.h"
#include "trysquare/trajectory/ape.h"
#include "trysquare/trajectory/error_by_length.h"
#include "trysquare/trajectory/error_unit.h"
#include "trysquare/trajectory/kitti_drift.h"
#include "trysquare/trajectory/paper_rpe.h"
#include "trysquare/trajectory/rpe.h"

#include "commands.h"
#include "exit_codes.h"
#include "result_table.h"
#include "trajectory_options.h"
#include "trajectory_outputs.h"
#include <fmt/format.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace trysquare::app {
namespace {

constexpr const char* kApeFooter = R"(Examples:
  trysquare ape groundtruth.txt estimate.txt --align
  trysquare ape gt.txt orb.txt -as -r full --interpolate --save-results orb.zip)";

constexpr const char* kRpeFooter = R"(Examples:
  trysquare rpe groundtruth.txt estimate.txt --delta 10 --delta_unit m --all_pairs
  trysquare rpe gt.txt orb.txt --kitti --json -)";

/// Letters as in evo.
const std::map<std::string, DeltaUnit> kDeltaUnits = {
    {"f", DeltaUnit::kFrames}, {"m", DeltaUnit::kMetres}, {"d", DeltaUnit::kDegrees}, {"r", DeltaUnit::kRadians}};

struct ApeOptions {
  TrajectoryOptions trajectories;
  TrajectoryOutputOptions output;
};

struct RpeOptions {
  TrajectoryOptions trajectories;
  TrajectoryOutputOptions output;
  std::string delta_unit = "f";
  PosePairSettings pairs;
  bool pairs_from_reference = false;
  bool kitti = false;
  bool by_length = false;
  std::vector<double> lengths_m;
  bool every_pair = false;
};

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

/// A unit that does not fit the relation is a mistake in the options, not a property of the data.
void change_unit_as_asked(const TrajectoryOptions& options, Outcome& outcome) {
  if (!options.unit.empty() && outcome.reason.empty()) change_unit(outcome.errors, options.unit);
}

template <class Settings>
void write_files(const TrajectoryOutputOptions& output, const TrajectoryPair& pair, const Settings& settings,
                 const Outcome& outcome) {
  if (!output.any() || !outcome.reason.empty()) return;
  const ErrorSeries series =
      error_series(outcome.errors, pair.poses.reference, pair.poses.estimate, settings.projection);
  write_trajectory_outputs(output, outcome.errors, series, pair.poses.reference,
                           evo_result(outcome.errors, settings, series, pair.facts.reference, pair.facts.estimate));
}

/// @param title  Of the table, without the number of errors.
void finish(const CommonOptions& common, const std::string& title, const Outcome& outcome, const std::string& more,
            const std::string& json) {
  if (common.prints_tables()) {
    fmt::print("{}{}",
               outcome.reason.empty() ? errors_table(title, outcome.errors)
                                      : fmt::format("{}\n\n  undefined: {}\n", title, outcome.reason),
               more);
  }
  write_json(common.json, json);
  if (!outcome.reason.empty()) throw NotMeaningful();
}

void run_ape(const ApeOptions& options) {
  const TrajectoryOptions& shared = options.trajectories;
  const ApeSettings settings{.relation = *pose_relation_named(shared.relation),
                             .alignment = shared.alignment(),
                             .num_poses_to_align = shared.num_poses_to_align,
                             .projection = shared.projection()};
  if (settings.relation == PoseRelation::kPointDistanceErrorRatio) {
    throw InvalidArgument(
        "--pose-relation = point_distance_error_ratio is for rpe: absolute errors have no such ratio");
  }
  options.output.check();
  TrajectoryPair pair = load_trajectories(shared);
  Outcome outcome =
      errors_or_reason(settings.relation, [&] { return ape(pair.poses.reference, pair.poses.estimate, settings); });
  change_unit_as_asked(shared, outcome);
  pair.facts.reason = outcome.reason;
  write_files(options.output, pair, settings, outcome);
  finish(shared.common,
         fmt::format("APE {} ({} poses, alignment {})", shared.relation, pair.poses.num_pairs,
                     name_of(settings.alignment)),
         outcome, "", to_json(outcome.errors, settings, pair.facts));
}

/// Drift of the estimate as it is: motions need no alignment, but its scale and projection are asked for.
RelativeErrors other_errors(const RpeOptions& options, const AssociatedTrajectories& poses) {
  RelativeErrors others;
  if (options.kitti) others.kitti_drift = kitti_drift(poses.reference, poses.estimate);
  if (options.by_length || !options.lengths_m.empty()) {
    others.by_length = error_by_length(poses.reference, poses.estimate, {.lengths_m = options.lengths_m});
  }
  if (options.every_pair) {
    others.every_pair = all_pairs_rpe(poses.reference, poses.estimate, options.trajectories.common.execution());
    others.paper_rpe_m2 = paper_rpe(poses.reference, poses.estimate);
  }
  return others;
}

void run_rpe(const RpeOptions& options) {
  const TrajectoryOptions& shared = options.trajectories;
  RpeSettings settings{.relation = *pose_relation_named(shared.relation),
                       .pairs = options.pairs,
                       .pairs_from_reference = options.pairs_from_reference,
                       .alignment = shared.alignment(),
                       .num_poses_to_align = shared.num_poses_to_align,
                       .projection = shared.projection()};
  settings.pairs.unit = kDeltaUnits.at(options.delta_unit);
  settings.pairs.validate();
  ErrorByLengthSettings{.lengths_m = options.lengths_m}.validate();
  options.output.check();
  TrajectoryPair pair = load_trajectories(shared);
  Outcome outcome =
      errors_or_reason(settings.relation, [&] { return rpe(pair.poses.reference, pair.poses.estimate, settings); });
  change_unit_as_asked(shared, outcome);
  pair.facts.reason = outcome.reason;
  const RelativeErrors others = other_errors(options, pair.poses);
  write_files(options.output, pair, settings, outcome);
  finish(shared.common,
         fmt::format("RPE {} ({} pairs, delta {:g} {}{})", shared.relation, outcome.errors.errors.size(),
                     options.pairs.delta, name_of(settings.pairs.unit), options.pairs.all_pairs ? ", all pairs" : ""),
         outcome, relative_errors_table(others), to_json(outcome.errors, settings, pair.facts, others));
}

}  // namespace

void add_ape(CLI::App& app) {
  auto options = std::make_shared<ApeOptions>();
  CLI::App& verb = *app.add_subcommand("ape", "Absolute pose error against a reference trajectory");
  verb.footer(kApeFooter);
  add_trajectory_options(verb, options->trajectories);
  add_trajectory_output_options(verb, options->output);
  verb.callback([options] { run_ape(*options); });
}

void add_rpe(CLI::App& app) {
  auto options = std::make_shared<RpeOptions>();
  CLI::App& verb = *app.add_subcommand("rpe", "Relative pose error against a reference trajectory");
  verb.footer(kRpeFooter);
  add_trajectory_options(verb, options->trajectories);
  const std::string group = "Which pairs";
  verb.add_option("-d,--delta", options->pairs.delta, "Distance of the two poses of a pair")
      ->capture_default_str()
      ->group(group);
  verb.add_option("-u,--delta-unit", options->delta_unit, "f: frames, m: metres, d: degrees, r: radians")
      ->check(CLI::IsMember({"f", "m", "d", "r"}))
      ->capture_default_str()
      ->group(group);
  verb.add_option("--delta-tol", options->pairs.relative_tolerance,
                  "For all pairs by m, d, r: how far a pair may be off delta, relative")
      ->capture_default_str()
      ->group(group);
  verb.add_flag("--all-pairs", options->pairs.all_pairs, "All pairs, not consecutive ones only")->group(group);
  verb.add_flag("--pairs-from-reference", options->pairs_from_reference,
                "Measure delta along the reference, not the estimate")
      ->group(group);
  const std::string more = "Other relative errors";
  verb.add_flag("--kitti", options->kitti, "Also the drift of KITTI's benchmark: % and degrees/100 m over 100 to 800 m")
      ->group(more);
  verb.add_flag("--by-length", options->by_length, "Also errors over 10, 20, ..., 50 % of the length of the reference")
      ->group(more);
  verb.add_option("--lengths", options->lengths_m, "Also errors over these lengths [m], as a comma list")
      ->delimiter(',')
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(more);
  verb.add_flag("--every-pair", options->every_pair,
                "Also the errors of every pair i < j whatever its distance, and the paper's RPE")
      ->group(more);
  add_trajectory_output_options(verb, options->output);
  verb.callback([options] { run_rpe(*options); });
}

}  // namespace trysquare::app
