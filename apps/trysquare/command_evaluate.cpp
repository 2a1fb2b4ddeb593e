// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/core/handedness.h"
#include "trysquare/io/trajectory_file.h"
#include "trysquare/pipeline/evaluate.h"
#include "trysquare/report/evaluation_json.h"

#include "commands.h"
#include "common_options.h"
#include "exit_codes.h"
#include "input_options.h"
#include "metric_options.h"
#include "outputs.h"
#include "result_table.h"
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <utility>

namespace trysquare::app {
namespace {

constexpr const char* kFooter = R"(Examples:
  trysquare evaluate sequences/00/velodyne sequences/00/poses.txt --report report.html
  trysquare evaluate 'pcs/*.pcd' poses --preset depth --json -
SCANS are a folder, a quoted pattern or a KITTI sequence, one file per scan; POSES a file, or a folder with one matrix per
scan. Exit codes: 0 ok, 2 usage, 3 unreadable or malformed input, 4 the numbers mean nothing.)";

struct EvaluateOptions {
  CommonOptions common;
  InputOptions input;
  MetricOptions metric;
  OutputOptions output;
  std::string subset_pose;
  bool timing = false;
};

/// The subset in the map frame, from the map frame or from the frame of the scan at --subset-pose.
OrthogonalSubset subset_in_map(const EvaluateOptions& options, const Inputs& inputs) {
  OrthogonalSubset subset = read_subset(options.metric.subset);
  if (options.input.left_handed) {
    for (OrthogonalSubset::Direction& direction : subset.directions) negate_y(direction.points_in_map);
  }
  if (options.subset_pose.empty()) return subset;
  Trajectory pose = read_trajectory(options.subset_pose).trajectory;
  if (pose.size() != 1) {
    throw IoError(fmt::format("{}: {} poses, one was expected: that of the scan that the subset was taken from",
                              options.subset_pose, pose.size()));
  }
  if (options.input.left_handed) pose = with_y_negated(std::move(pose));
  if (inputs.extrinsic) pose = inputs.extrinsic->apply(pose);
  return transformed(general_inverse(inputs.world_from_scan.world_from_scan.front()) * pose.world_from_scan.front(),
                     std::move(subset));
}

EvaluationFacts facts_of(const EvaluateOptions& options, const Inputs& inputs, double wall_time_s) {
  const auto typed = [](const std::string& text) { return text.empty() ? std::nullopt : std::optional(text); };
  return {.version = TRYSQUARE_VERSION,
          .scans = options.input.scans,
          .poses = options.input.poses,
          .left_handed = options.input.left_handed,
          .poses_format = std::string(name_of(inputs.format)),
          .extrinsic = inputs.extrinsic ? std::optional(inputs.extrinsic->description) : std::nullopt,
          .reference = typed(options.input.reference),
          .reference_extrinsic =
              inputs.reference_extrinsic ? std::optional(inputs.reference_extrinsic->description) : std::nullopt,
          .subset = typed(options.metric.subset),
          .wall_time_s = options.timing ? std::optional(wall_time_s) : std::nullopt};
}

void run(const EvaluateOptions& options) {
  const EvaluationSettings settings = options.metric.resolve();
  if (!options.subset_pose.empty() && options.metric.subset.empty()) {
    throw InvalidArgument("--subset-pose is given without --subset");
  }
  options.output.check(options.common.json);
  Inputs inputs = load_inputs(options.input);
  if (inputs.extrinsic && options.common.verbose) options.common.note("extrinsic: " + inputs.extrinsic->description);
  EvaluationContext context{.reference = inputs.reference};
  if (inputs.extrinsic) context.body_from_sensor = inputs.extrinsic->body_from_sensor;
  if (!options.metric.subset.empty()) context.subset = subset_in_map(options, inputs);

  const auto started = std::chrono::steady_clock::now();
  Evaluation evaluation =
      evaluate(*inputs.scans, inputs.world_from_scan, settings, context, options.common.execution());
  evaluation.warnings.insert(evaluation.warnings.begin(), inputs.warnings.begin(), inputs.warnings.end());
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started;
  const std::string json = to_json(evaluation, facts_of(options, inputs, elapsed.count()));
  write_outputs(options.output, evaluation, json, inputs.poses_as_read);
  options.common.warn(evaluation.warnings);
  if (options.common.prints_tables()) fmt::print("{}", evaluation_table(evaluation, may_use_color(1)));
  write_json(options.common.json, json);
  if (!evaluation.verdict.meaningful) throw NotMeaningful();
}

}  // namespace

void add_evaluate(CLI::App& app) {
  auto options = std::make_shared<EvaluateOptions>();
  CLI::App& verb =
      *app.add_subcommand("evaluate", "MME, MPV, OMME, MOM and overlap of the map that poses make of scans");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  add_json_option(verb, options->common);
  verb.add_option("SCANS", options->input.scans, "Scans: folder, quoted pattern, or KITTI sequence")->required();
  verb.add_option("POSES", options->input.poses, "Poses: KITTI, TUM or EuRoC file, or matrices")->required();
  verb.add_option("--reference", options->input.reference, "True poses of the same scans, for RPE and APE");
  verb.add_option("--window", options->metric.settings.window,
                  "Also evaluate windows of this many scans; default 10 when there are at least 20 scans");
  verb.add_option("--stride", options->metric.settings.stride,
                  "Scans from one window to the next; default: the window");
  add_metric_options(verb, options->metric);
  verb.add_option("--subset-pose", options->subset_pose,
                  "File with the pose of the scan in whose frame the points of --subset are")
      ->group("Metric options");
  add_range_options(verb, options->metric.settings.min_range_m, options->metric.settings.max_range_m);
  add_scan_options(verb, options->input);
  add_pose_options(verb, options->input);
  add_output_options(verb, options->output);
  verb.add_flag("--timing", options->timing, "Say in the JSON how long it took")->group("Outputs");
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
