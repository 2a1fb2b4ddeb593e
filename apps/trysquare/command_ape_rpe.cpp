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
  trysquare ape groundtruth.txt estimate.txt --align --plot errors.png
  trysquare ape gt.txt orb.txt -as -r full --interpolate --save-results orb.zip)";

constexpr const char* kRpeFooter = R"(Examples:
  trysquare rpe groundtruth.txt estimate.txt --delta 10 --delta_unit m --all_pairs --out results
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

/// Both trajectories and the errors; without errors, facts.reason says why.
struct Comparison {
  TrajectoryPair pair;
  TrajectoryErrors errors;

  bool is_defined() const { return pair.facts.reason.empty(); }
};

/// Settings were checked before: what is refused now has no value, such as the alignment of a straight line. A unit
/// that does not fit the relation, however, is a mistake in the options, not a property of the data.
template <class Settings>
Comparison compare(const TrajectoryOptions& options, const TrajectoryOutputOptions& output, const Settings& settings,
                   TrajectoryErrors (*errors_of)(const Trajectory&, const Trajectory&, const Settings&)) {
  output.check();
  Comparison result{.pair = load_trajectories(options), .errors = {.relation = settings.relation}};
  try {
    result.errors = errors_of(result.pair.poses.reference, result.pair.poses.estimate, settings);
  } catch (const InvalidArgument& error) {
    result.pair.facts.reason = error.what();
    return result;
  }
  if (!options.unit.empty()) change_unit(result.errors, options.unit);
  return result;
}

/// Of all pairs a pose would be there once for each of its pairs: they are left out.
bool stores_trajectories(const ApeSettings& /*settings*/) { return true; }
bool stores_trajectories(const RpeSettings& settings) { return !settings.pairs.all_pairs; }

template <class Settings>
void write_files(const TrajectoryOutputOptions& output, const Comparison& comparison, const Settings& settings) {
  if (!output.any() || !comparison.is_defined()) return;
  const auto& [pair, errors] = comparison;
  const Trajectory& reference = pair.poses.reference;
  const Trajectory& estimate = pair.poses.estimate;
  TrajectoryOutputs outputs{.series = error_series(errors, reference, estimate, settings.projection),
                            .reference_name = pair.facts.reference,
                            .estimate_name = pair.facts.estimate};
  outputs.evo = evo_result(errors, settings, outputs.series, pair.facts.reference, pair.facts.estimate);
  if (stores_trajectories(settings)) {
    outputs.compared = compared_trajectories(errors, reference, estimate, settings.projection);
  }
  write_trajectory_outputs(output, errors, reference, outputs);
}

/// @param title  Of the table, without the number of errors.
void print(const Comparison& comparison, const std::string& title, const std::string& more) {
  fmt::print("{}{}",
             comparison.is_defined() ? errors_table(title, comparison.errors)
                                     : fmt::format("{}\n\n  undefined: {}\n", title, comparison.pair.facts.reason),
             more);
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
  const Comparison comparison = compare(shared, options.output, settings, ape);
  const std::string json = to_json(comparison.errors, settings, comparison.pair.facts);
  write_trajectory_json(options.output, "ape", json);
  write_files(options.output, comparison, settings);
  if (shared.common.prints_tables()) {
    print(comparison,
          fmt::format("APE {} ({} poses, alignment {})", shared.relation, comparison.pair.poses.num_pairs,
                      name_of(settings.alignment)),
          "");
  }
  write_json(shared.common.json, json);
  if (!comparison.is_defined()) throw NotMeaningful();
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
  const Comparison comparison = compare(shared, options.output, settings, rpe);
  const RelativeErrors others = other_errors(options, comparison.pair.poses);
  const std::string json = to_json(comparison.errors, settings, comparison.pair.facts, others);
  write_trajectory_json(options.output, "rpe", json);
  write_files(options.output, comparison, settings);
  if (shared.common.prints_tables()) {
    print(comparison,
          fmt::format("RPE {} ({} pairs, delta {:g} {}{})", shared.relation, comparison.errors.errors.size(),
                      options.pairs.delta, name_of(settings.pairs.unit), options.pairs.all_pairs ? ", all pairs" : ""),
          relative_errors_table(others));
  }
  write_json(shared.common.json, json);
  if (!comparison.is_defined()) throw NotMeaningful();
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
