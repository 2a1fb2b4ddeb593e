// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/io/file.h"
#include "trysquare/pipeline/diagnosis.h"
#include "trysquare/report/diagnosis_json.h"

#include "commands.h"
#include "common_options.h"
#include "console.h"
#include "exit_codes.h"
#include "input_options.h"
#include "outputs.h"
#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace trysquare::app {
namespace {

constexpr const char* kFooter = R"(Examples:
  trysquare diagnose sequences/00/velodyne sequences/00/poses.txt
  trysquare diagnose 'clouds/*.pcd' poses.tum --preset depth --json diagnosis.json
Says what is wrong with scans and poses and what to do: frames, calibration, handedness, clocks, missing scans, overlap,
then the poses that stand out, then surfaces that the map shows twice. What is found does not change the exit code.
Exit codes: 0 ok, 2 usage, 3 unreadable or malformed input, 4 nothing could be judged.)";

constexpr std::size_t kMostRowsOfOneKind = 10;

struct DiagnoseOptions {
  CommonOptions common;
  InputOptions input;
  std::string preset = "lidar";
  std::string directory;
  DiagnosisSettings diagnosis;
  double min_range_m = 0;
  double max_range_m = std::numeric_limits<double>::infinity();

  DiagnosisSettings settings() const {
    DiagnosisSettings result = diagnosis;
    if (preset == "depth") result.adjustment = AdjustmentSettings::room_scale();
    result.adjustment.min_range_m = min_range_m;
    result.adjustment.max_range_m = max_range_m;
    return result;
  }
};

std::string error_row(const Diagnosis& diagnosis) {
  if (!diagnosis.estimate) return fmt::format("  error of the poses  {}\n", diagnosis.blame_reason);
  const RpeEstimate& estimate = *diagnosis.estimate;
  if (!estimate.translation_rms_m) return "  error of the poses  cannot be told: see below\n";
  return fmt::format("  error of the poses  {:.3g} m, {:.3g}° (RPE of all pairs; {})\n", *estimate.translation_rms_m,
                     *estimate.rotation_rms_rad * 180 / std::numbers::pi, name_of(estimate.status));
}

std::string time_row(const TimeOffset& time) {
  if (!time.offset_s) return fmt::format("  time offset         {}\n", time.reason);
  return fmt::format("  time offset         {:.0f} ms\n", 1000 * *time.offset_s);
}

/// Findings in their order; of one kind no more than can be read.
std::string findings_table(const std::vector<Finding>& findings, bool color) {
  if (findings.empty()) return "\nNothing is wrong.\n";
  std::map<std::string, std::size_t> num_of_kind;
  std::string text = "\n";
  for (const Finding& finding : findings) {
    if (++num_of_kind[finding.id] > kMostRowsOfOneKind) continue;
    const std::string label = fmt::format("{} {}", name_of(finding.severity), finding.id);
    text += fmt::format("{}\n  {}\n  -> {}\n", color ? fmt::format("\033[1m{}\033[0m", label) : label, finding.message,
                        finding.remedy);
  }
  for (const auto& [id, count] : num_of_kind) {
    if (count > kMostRowsOfOneKind)
      text += fmt::format("... and {} more {}: see --json\n", count - kMostRowsOfOneKind, id);
  }
  return text;
}

std::string table_of(const Diagnosis& diagnosis, bool color) {
  std::string text = fmt::format("{} scan{}\n\n", diagnosis.num_scans, diagnosis.num_scans == 1 ? "" : "s");
  if (diagnosis.reason.empty()) {
    text += error_row(diagnosis);
    text += time_row(diagnosis.time_offset);
  } else {
    text += fmt::format("Nothing could be judged: {}\n", diagnosis.reason);
  }
  const bool is_all_well = diagnosis.reason.empty() || !diagnosis.findings.empty();
  return is_all_well ? text + findings_table(diagnosis.findings, color) : text;
}

/// What to do about something that a reader of files has to say.
std::string remedy_of(const std::string& code) {
  static const std::map<std::string, std::string> remedies = {
      {"rounded_poses", "write positions with six decimals or more"},
      {"rotation_not_orthonormal", "write rotations with nine digits or more, or as quaternions"},
      {"non_unit_quaternion", "write quaternions with nine digits or more"},
      {"time_stamps_not_increasing", "sort the poses by time, and look for clocks that were set back"},
      {"scans_without_pose", "give poses for all scans, or a larger --t-max-diff"},
      {"times_differ", "check that scans and poses use one clock; see --t-max-diff"},
      {"left_handed_poses", "give --left-handed"}};
  const auto found = remedies.find(code);
  return found == remedies.end() ? "see to the file, and diagnose it again" : found->second;
}

/// What the readers of the files have to say comes first.
void prepend(const std::vector<Diagnostic>& of_files, std::vector<Finding>& findings) {
  std::vector<Finding> all;
  for (const Diagnostic& each : of_files) {
    all.push_back(
        {.id = each.code, .severity = Severity::kWarning, .message = each.message, .remedy = remedy_of(each.code)});
  }
  all.insert(all.end(), findings.begin(), findings.end());
  findings = std::move(all);
}

void run(const DiagnoseOptions& options) {
  const DiagnosisSettings settings = options.settings();
  settings.validate();
  if (!options.common.json.empty() && options.common.json != "-") require_writable_file(options.common.json);
  if (!options.directory.empty()) require_possible_folder(options.directory);
  const Inputs inputs = load_inputs(options.input);
  DiagnosisContext context;
  if (inputs.extrinsic) context.body_from_sensor = inputs.extrinsic->body_from_sensor;
  if (!inputs.all_poses.stamps_ns.empty()) context.all_poses = inputs.all_poses;
  Diagnosis diagnosis = diagnose(*inputs.scans, inputs.world_from_scan, settings, context, options.common.execution());
  prepend(inputs.warnings, diagnosis.findings);

  const std::string json =
      to_json(diagnosis, settings,
              {.version = TRYSQUARE_VERSION,
               .scans = options.input.scans,
               .poses = options.input.poses,
               .poses_format = std::string(name_of(inputs.format)),
               .left_handed = options.input.left_handed,
               .extrinsic = inputs.extrinsic ? std::optional(inputs.extrinsic->description) : std::nullopt});
  if (!options.directory.empty()) {
    make_folder(options.directory);
    write_file(std::filesystem::path(options.directory) / "diagnosis.json", json);
    write_file(std::filesystem::path(options.directory) / "findings.csv", findings_csv(json));
  }
  if (options.common.prints_tables()) fmt::print("{}", table_of(diagnosis, may_use_color(1)));
  write_json(options.common.json, json);
  if (!diagnosis.reason.empty()) throw NotMeaningful();
}

}  // namespace

void add_diagnose(CLI::App& app) {
  auto options = std::make_shared<DiagnoseOptions>();
  CLI::App& verb = *app.add_subcommand("diagnose", "What is wrong with scans and poses, from frames to single poses");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  add_json_option(verb, options->common);
  verb.add_option("SCANS", options->input.scans, "Scans: folder, quoted pattern, or KITTI sequence")->required();
  verb.add_option("POSES", options->input.poses, "Poses: KITTI, TUM or EuRoC file, or matrices")->required();
  verb.add_option("--radius", options->diagnosis.radius_m, "Of the neighborhoods by which frames are compared [m]")
      ->capture_default_str();
  verb.add_option("--max-time-offset", options->diagnosis.max_time_offset_s,
                  "Offsets between the clocks of scans and poses are sought up to this [s]")
      ->capture_default_str();
  verb.add_option("--preset", options->preset, "lidar: outdoors; depth: patches of a fifth, for rooms")
      ->check(CLI::IsMember({"lidar", "depth"}))
      ->capture_default_str();
  add_range_options(verb, options->min_range_m, options->max_range_m);
  add_scan_options(verb, options->input);
  add_pose_options(verb, options->input);
  verb.add_option("--out", options->directory, "Write diagnosis.json and findings.csv into this folder")
      ->group("Outputs");
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
