// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/io/read_points.h"
#include "trysquare/io/scan_files.h"
#include "trysquare/io/trajectory_file.h"

#include "commands.h"
#include "common_options.h"
#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace trysquare::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFooter = R"(Examples:
  trysquare info scan.pcd map.ply poses.txt
  trysquare info sequences/00)";

struct InfoOptions {
  CommonOptions common;
  std::vector<std::string> files;
};

std::string describe_points(const PointTable& table) {
  std::size_t num_not_finite = 0;
  std::size_t num_at_origin = 0;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : table.points) {
    if (!point.allFinite()) {
      ++num_not_finite;
    } else {
      box.extend(point);
      if (point.isZero(0)) ++num_at_origin;
    }
  }
  std::string text = fmt::format("  points: {}, not finite: {}, at (0, 0, 0): {}\n", table.points.size(),
                                 num_not_finite, num_at_origin);
  if (!box.isEmpty()) {
    text += fmt::format("  from [{:g} {:g} {:g}] to [{:g} {:g} {:g}] m\n", box.min().x(), box.min().y(), box.min().z(),
                        box.max().x(), box.max().y(), box.max().z());
  }
  if (!table.columns.empty()) {
    text += "  columns:";
    for (const PointTable::Column& column : table.columns) text += " " + column.name;
    text += "\n";
  }
  return text;
}

std::string describe_trajectory(const TrajectoryFile& file) {
  const Trajectory& trajectory = file.trajectory;
  double path_m = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    path_m += (trajectory.world_from_scan[i].translation - trajectory.world_from_scan[i - 1].translation).norm();
  }
  std::string text =
      fmt::format("  poses: {}, format: {}, path: {:.6g} m\n", trajectory.size(), name_of(file.format), path_m);
  if (!trajectory.stamps_ns.empty()) {
    const auto [first, last] = std::minmax_element(trajectory.stamps_ns.begin(), trajectory.stamps_ns.end());
    text +=
        fmt::format("  time: {} ns to {} ns, {:.6g} s\n", *first, *last, static_cast<double>(*last - *first) * 1e-9);
  }
  for (const Diagnostic& warning : file.warnings)
    text += fmt::format("  warning: {} [{}]\n", warning.message, warning.code);
  return text;
}

std::string describe_folder(const std::string& folder) {
  try {
    const ScanFiles scans = open_scans(folder);
    return fmt::format("  scans: {}, {} to {}, time stamps: {}\n  first scan:\n{}", scans.size(),
                       scans.paths().front().filename().string(), scans.paths().back().filename().string(),
                       scans.stamps_ns().empty() ? "none" : "yes", describe_points(read_points(scans.paths().front())));
  } catch (const IoError& no_scans) {
    try {
      return describe_trajectory(read_trajectory(folder));
    } catch (const IoError& no_poses) {
      throw IoError(std::string(no_scans.what()) + "; as poses: " + no_poses.what());
    }
  }
}

/// Text files may be both; poses have a fixed shape, so they are tried first.
bool is_text(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".txt" || extension == ".csv" || extension == ".tum" || extension == ".kitti";
}

std::string describe(const std::string& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) return describe_folder(file);
  if (!is_text(file)) return describe_points(read_points(file));
  try {
    return describe_trajectory(read_trajectory(file));
  } catch (const IoError&) {
    if (!known_point_format(file)) throw;
    return describe_points(read_points(file));
  }
}

void run(const InfoOptions& options) {
  std::string text;
  for (const std::string& file : options.files) text += file + "\n" + describe(file);
  fmt::print("{}", text);
}

}  // namespace

void add_info(CLI::App& app) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App& verb = *app.add_subcommand("info", "What files hold: points, columns, extent; poses, format, path");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  verb.add_option("FILE", options->files, "Scans, maps, trajectories, or folders of them")
      ->required()
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
