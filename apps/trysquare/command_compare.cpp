// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/io/file.h"
#include "trysquare/pipeline/compare.h"
#include "trysquare/report/comparison_json.h"

#include "commands.h"
#include "common_options.h"
#include "comparison_table.h"
#include "exit_codes.h"
#include "input_options.h"
#include "metric_options.h"
#include "outputs.h"
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace trysquare::app {
namespace {

constexpr const char* kFooter = R"(Examples:
  trysquare compare sequences/00/velodyne lio.txt slam.txt sequences/00/poses.txt
  trysquare compare 'clouds/*.pcd' a.tum b.tum c.tum --metrics rpe,mom --json comparison.json
Every trajectory is evaluated by itself and measured against the poses in which the scans agree; values of the same windows
of scans are then paired. p-values are exact, corrected for the number of pairs. Trajectories that cannot be told apart
share a rank. Exit codes: 0 ok, 2 usage, 3 unreadable or malformed input, 4 nothing could be compared.)";

struct CompareOptions {
  CommonOptions common;
  InputOptions input;
  MetricOptions metric;
  std::vector<std::string> poses;
  std::string directory;
  double confidence = ComparisonSettings{}.confidence;
};

/// Names as short as they can be told apart: the file's, or all that was typed.
std::vector<std::string> names_of(const std::vector<std::string>& poses) {
  std::vector<std::string> short_names;
  for (const std::string& each : poses) {
    const std::filesystem::path path = each;
    short_names.push_back((path.has_stem() ? path.stem() : path.parent_path().stem()).string());
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool is_unique = std::count(short_names.begin(), short_names.end(), short_names[i]) == 1;
    names.push_back(is_unique && !short_names[i].empty() ? short_names[i] : poses[i]);
  }
  return names;
}

std::vector<Candidate> candidates_of(const ComparedInputs& inputs, const std::vector<std::string>& names) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const ComparedInputs::Poses& poses = inputs.trajectories[i];
    candidates.push_back({.name = names[i], .world_from_scan = poses.world_from_scan, .body_from_sensor = {}});
    if (poses.extrinsic) candidates.back().body_from_sensor = poses.extrinsic->body_from_sensor;
  }
  return candidates;
}

ComparisonFacts facts_of(const CompareOptions& options, const ComparedInputs& inputs) {
  ComparisonFacts facts{
      .version = TRYSQUARE_VERSION, .scans = options.input.scans, .left_handed = options.input.left_handed};
  for (const ComparedInputs::Poses& each : inputs.trajectories) {
    facts.sources.push_back({.poses = each.poses,
                             .poses_format = std::string(name_of(each.format)),
                             .extrinsic = each.extrinsic ? std::optional(each.extrinsic->description) : std::nullopt});
  }
  return facts;
}

/// Warnings say which trajectory they are of.
void warn(const CompareOptions& options, const Comparison& comparison) {
  for (const ComparedTrajectory& trajectory : comparison.trajectories) {
    std::vector<Diagnostic> named = trajectory.evaluation.warnings;
    for (Diagnostic& each : named) each.message = trajectory.name + ": " + each.message;
    options.common.warn(named);
  }
}

void run(const CompareOptions& options) {
  const ComparisonSettings settings{.evaluation = options.metric.resolve(), .confidence = options.confidence};
  settings.validate();
  if (!options.metric.subset.empty()) throw InvalidArgument("compare takes no --subset: it extracts one of each map");
  if (options.poses.size() < 2) throw InvalidArgument("compare needs at least two POSES");
  if (!options.common.json.empty() && options.common.json != "-") require_writable_file(options.common.json);
  if (!options.directory.empty()) require_possible_folder(options.directory);
  const ComparedInputs inputs = load_compared_inputs(options.input, options.poses);
  Comparison comparison =
      compare(*inputs.scans, candidates_of(inputs, names_of(options.poses)), settings, options.common.execution());
  for (std::size_t i = 0; i < inputs.trajectories.size(); ++i) {
    std::vector<Diagnostic>& warnings = comparison.trajectories[i].evaluation.warnings;
    warnings.insert(warnings.begin(), inputs.trajectories[i].warnings.begin(), inputs.trajectories[i].warnings.end());
  }
  const std::string json = to_json(comparison, facts_of(options, inputs));
  if (!options.directory.empty()) {
    make_folder(options.directory);
    const std::filesystem::path folder = options.directory;
    write_file(folder / "comparison.json", json);
    write_file(folder / "windows.csv", windows_csv(comparison));
  }
  warn(options, comparison);
  if (options.common.prints_tables()) fmt::print("{}", comparison_table(comparison, may_use_color(1)));
  write_json(options.common.json, json);
  if (!comparison.verdict.meaningful) throw NotMeaningful();
}

}  // namespace

void add_compare(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App& verb = *app.add_subcommand("compare", "Which of several trajectories of the same scans is better");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  add_json_option(verb, options->common);
  verb.add_option("SCANS", options->input.scans, "Scans: folder, quoted pattern, or KITTI sequence")->required();
  verb.add_option("POSES", options->poses, "Two or more: KITTI, TUM or EuRoC files, or matrices")->required();
  verb.add_option("--window", options->metric.settings.window,
                  "Scans per window; default: 2 to 10, so that there are ten windows if possible");
  verb.add_option("--stride", options->metric.settings.stride,
                  "Scans from one window to the next; default: the window");
  verb.add_option("--confidence", options->confidence, "Of intervals; a difference is real at p <= 1 - confidence")
      ->capture_default_str();
  add_metric_options(verb, options->metric);
  add_range_options(verb, options->metric.settings.min_range_m, options->metric.settings.max_range_m);
  add_scan_options(verb, options->input);
  add_pose_options(verb, options->input);
  verb.add_option("--out", options->directory, "Folder for comparison.json and windows.csv")->group("Outputs");
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
