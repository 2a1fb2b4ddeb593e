// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/io/trajectory_file.h"
#include "trysquare/io/write_trajectory.h"
#include "trysquare/synthetic/perturb.h"

#include "commands.h"
#include "common_options.h"
#include "input_options.h"
#include "outputs.h"
#include <fmt/format.h>

#include <memory>
#include <numbers>
#include <string>

namespace trysquare::app {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

constexpr const char* kFooter = R"(Examples:
  trysquare perturb poses.txt -o noisy.txt --translation 0.05 --rotation 0.02
  trysquare perturb poses.tum -o drifting.tum --translation 0.01 --model walk --seed 7
white: every pose is moved by itself. walk: the errors of all steps so far add up; the first pose stays. Translation is
along the axes of the world of the file, rotation about those of the moving frame. Frame, time stamps and format are
those of the input; quaternions hold rotations only, so a matrix that is none comes back as one.)";

struct PerturbOptions {
  CommonOptions common;
  std::string input;
  std::string output;
  std::string format = "auto";
  std::string model = "white";
  double translation_m = 0;
  double rotation_deg = 0;

  PerturbationSettings settings() const {
    return {.translation_sigma_m = translation_m,
            .rotation_sigma_rad = rotation_deg * kRadiansPerDegree,
            .seed = common.seed,
            .model = *noise_model_named(model)};
  }
};

void run(const PerturbOptions& options) {
  options.settings().validate();
  if (options.translation_m == 0 && options.rotation_deg == 0) {
    throw InvalidArgument("--translation and --rotation are 0: there is nothing to do");
  }
  require_writable_file(options.output);
  const TrajectoryFile file = read_trajectory(options.input, format_option(options.format));
  options.common.warn(file.warnings);
  write_trajectory(options.output, perturb(file.trajectory, options.settings()), file.format);
  if (options.common.verbose) {
    options.common.note(
        fmt::format("written: {}: {} poses, {}", options.output, file.trajectory.size(), name_of(file.format)));
  }
}

}  // namespace

void add_perturb(CLI::App& app) {
  auto options = std::make_shared<PerturbOptions>();
  CLI::App& verb = *app.add_subcommand("perturb", "A trajectory with random errors, of a size and kind of choice");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  verb.add_option("POSES", options->input, "Trajectory: TUM, KITTI, EuRoC, or matrices")->required();
  verb.add_option("-o,--output", options->output, "File to write, in the format of POSES")->required();
  verb.add_option("--translation", options->translation_m, "Standard deviation per axis of a pose or a step [m]")
      ->capture_default_str();
  verb.add_option("--rotation", options->rotation_deg, "Standard deviation per axis of a pose or a step [degrees]")
      ->capture_default_str();
  verb.add_option("--model", options->model, "white: errors of poses; walk: errors of steps, which add up")
      ->check(CLI::IsMember({"white", "walk"}))
      ->capture_default_str();
  verb.add_option("--poses-format", options->format, "Format of POSES")
      ->check(CLI::IsMember({"auto", "kitti", "tum", "euroc", "matrix"}))
      ->capture_default_str();
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
