// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/core/handedness.h"
#include "trysquare/io/read_points.h"
#include "trysquare/io/trajectory_file.h"
#include "trysquare/io/write_bin.h"
#include "trysquare/io/write_ply.h"
#include "trysquare/io/write_trajectory.h"

#include "commands.h"
#include "common_options.h"
#include "input_options.h"
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

namespace trysquare::app {
namespace {

constexpr const char* kFooter = R"(Examples:
  trysquare convert scan.pcd scan.ply
  trysquare convert poses.txt poses.tum
  trysquare convert poses.txt out.txt --to kitti
  trysquare convert transforms.csv poses.kitti --left-handed)";

struct ConvertOptions {
  CommonOptions common;
  std::string input;
  std::string output;
  std::string from = "auto";
  std::string to = "auto";
  bool left_handed = false;
};

/// "ply", "bin", "tum", ...: as asked for, or by the ending of the output.
std::string target_format(const ConvertOptions& options) {
  if (options.to != "auto") return options.to;
  const std::string extension = std::filesystem::path(options.output).extension().string();
  if (extension == ".ply" || extension == ".bin" || extension == ".tum" || extension == ".kitti")
    return extension.substr(1);
  throw InvalidArgument(
      fmt::format("{}: the ending does not say which format is meant: give --to ply, bin, tum, kitti, "
                  "euroc or matrix",
                  options.output));
}

void run(const ConvertOptions& options) {
  const std::string to = target_format(options);
  if (const std::optional<TrajectoryFormat> format = trajectory_format_named(to)) {
    TrajectoryFile file = read_trajectory(options.input, format_option(options.from));
    options.common.warn(file.warnings);
    if (options.left_handed) file.trajectory = with_y_negated(std::move(file.trajectory));
    const bool needs_time = *format == TrajectoryFormat::kTum || *format == TrajectoryFormat::kEuroc;
    if (needs_time && file.trajectory.stamps_ns.empty()) {
      options.common.note(options.input + ": has no time stamps: pose i gets i seconds");
    }
    write_trajectory(options.output, file.trajectory, *format);
  } else {
    PointTable table = read_points(options.input);
    if (options.left_handed) negate_y(table.points);
    if (to == "ply") write_ply(options.output, table);
    if (to == "bin") write_kitti_bin(options.output, table.points);
  }
  if (options.common.verbose) options.common.note("written: " + options.output);
}

}  // namespace

void add_convert(CLI::App& app) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App& verb = *app.add_subcommand("convert", "Scans, maps and trajectories from one format to another");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  verb.add_option("IN", options->input, "Point file, or trajectory")->required();
  verb.add_option("OUT", options->output, "File to write; its ending says what: .ply, .bin, .tum, .kitti; or --to does")
      ->required();
  verb.add_option("--from", options->from, "Format of a trajectory that is read")
      ->check(CLI::IsMember(poses_formats()))
      ->capture_default_str();
  verb.add_option("--to", options->to, "Format that is written")
      ->check(CLI::IsMember({"auto", "ply", "bin", "tum", "kitti", "euroc", "matrix"}))
      ->capture_default_str();
  verb.add_flag("--left-handed", options->left_handed, "What is read is left-handed, as CARLA writes it: y is negated");
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
