// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/rpe_estimate.h"
#include "trysquare/core/error.h"
#include "trysquare/io/write_trajectory.h"

#include "commands.h"
#include "common_options.h"
#include "console.h"
#include "exit_codes.h"
#include "input_options.h"
#include "outputs.h"
#include <fmt/format.h>

#include <limits>
#include <memory>
#include <numbers>
#include <string>

namespace trysquare::app {
namespace {

constexpr const char* kFooter = R"(Examples:
  trysquare refine sequences/00/velodyne sequences/00/poses.txt -o adjusted.txt
  trysquare refine 'clouds/*.pcd' poses.tum -o adjusted.tum --preset depth
Writes the poses in which the scans agree on their planar surfaces, in the format, frame and convention of POSES; the first
pose stays. Where the scans do not say enough nothing is written. Exit codes: 0 ok, 2 usage, 3 unreadable or malformed
input, 4 no adjusted trajectory that means anything.)";

struct RefineOptions {
  CommonOptions common;
  InputOptions input;
  std::string output;
  std::string preset = "lidar";
  double min_range_m = 0;
  double max_range_m = std::numeric_limits<double>::infinity();

  AdjustmentSettings settings() const {
    AdjustmentSettings result = preset == "depth" ? AdjustmentSettings::room_scale() : AdjustmentSettings{};
    result.min_range_m = min_range_m;
    result.max_range_m = max_range_m;
    return result;
  }
};

/// What the correction amounts to, for people.
std::string summary(const RpeEstimate& estimate) {
  const double rotation_deg = *estimate.rotation_rms_rad * 180 / std::numbers::pi;
  return fmt::format("{} iterations on {} patches; the given poses are {:.4g} m and {:.3g}° off (RPE, all pairs, {})",
                     estimate.num_iterations, estimate.num_patches, *estimate.translation_rms_m, rotation_deg,
                     name_of(estimate.status));
}

void run(const RefineOptions& options) {
  options.settings().validate();
  require_writable_file(options.output);
  const Inputs inputs = load_inputs(options.input);
  options.common.warn(inputs.warnings);
  const RpeEstimate estimate =
      estimate_rpe(*inputs.scans, inputs.world_from_scan, options.settings(), options.common.execution());
  if (estimate.status == EstimateStatus::kRefused) {
    std::string message = "nothing is written, the scans do not say where they stood:";
    for (const std::string& reason : estimate.reasons) message += "\n  - " + reason;
    print_error(message + "\n  trysquare diagnose says what may be wrong");
    throw NotMeaningful();
  }
  write_trajectory(options.output, poses_as_in_file(estimate.adjusted, inputs, options.input), inputs.format);
  if (!options.common.quiet) fmt::print("{}\nwritten: {}\n", summary(estimate), options.output);
}

}  // namespace

void add_refine(CLI::App& app) {
  auto options = std::make_shared<RefineOptions>();
  CLI::App& verb = *app.add_subcommand("refine", "The trajectory in which the scans agree on their flat surfaces");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  verb.add_option("SCANS", options->input.scans, "Scans: folder, quoted pattern, or KITTI sequence")->required();
  verb.add_option("POSES", options->input.poses, "Poses: KITTI, TUM or EuRoC file, or matrices")->required();
  verb.add_option("-o,--output", options->output, "File to write, in the format of POSES")->required();
  verb.add_option("--preset", options->preset, "lidar: outdoors; depth: patches of a fifth, for rooms")
      ->check(CLI::IsMember({"lidar", "depth"}))
      ->capture_default_str();
  add_range_options(verb, options->min_range_m, options->max_range_m);
  add_scan_options(verb, options->input);
  add_pose_options(verb, options->input);
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
