// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/io/read_points.h"
#include "trysquare/io/scan_files.h"
#include "trysquare/io/trajectory_file.h"

#include "commands.h"
#include "common_options.h"
#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace trysquare::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFooter = R"(Examples:
  trysquare info scan.pcd map.ply poses.txt
  trysquare info sequences/00)";

struct InfoOptions {
  CommonOptions common;
  std::vector<std::string> files;
};

Json array_of(const Eigen::Vector3d& vector) { return Json::array({vector.x(), vector.y(), vector.z()}); }

Json describe_points(const PointTable& table) {
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
  Json json = {{"kind", "points"},
               {"num_points", table.points.size()},
               {"num_not_finite", num_not_finite},
               {"num_at_origin", num_at_origin}};
  json["min_m"] = box.isEmpty() ? Json(nullptr) : array_of(box.min());
  json["max_m"] = box.isEmpty() ? Json(nullptr) : array_of(box.max());
  json["columns"] = Json::array();
  for (const PointTable::Column& column : table.columns) json["columns"].push_back(column.name);
  return json;
}

Json describe_trajectory(const TrajectoryFile& file) {
  const Trajectory& trajectory = file.trajectory;
  double path_m = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    path_m += (trajectory.world_from_scan[i].translation - trajectory.world_from_scan[i - 1].translation).norm();
  }
  Json json = {{"kind", "trajectory"},
               {"format", name_of(file.format)},
               {"num_poses", trajectory.size()},
               {"path_length_m", path_m}};
  if (!trajectory.stamps_ns.empty()) {
    const auto [first, last] = std::minmax_element(trajectory.stamps_ns.begin(), trajectory.stamps_ns.end());
    json["first_stamp_ns"] = *first;
    json["last_stamp_ns"] = *last;
    json["duration_s"] = static_cast<double>(*last - *first) * 1e-9;
  }
  for (const Diagnostic& warning : file.warnings) json["warnings"].push_back(warning.message);
  return json;
}

Json describe_folder(const std::string& folder) {
  try {
    const ScanFiles scans = open_scans(folder);
    return {{"kind", "scans"},
            {"num_scans", scans.size()},
            {"first", scans.paths().front().filename().string()},
            {"last", scans.paths().back().filename().string()},
            {"has_time_stamps", !scans.stamps_ns().empty()},
            {"first_scan", describe_points(read_points(scans.paths().front()))}};
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

Json describe(const std::string& file) {
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

/// One `key: value` a line, objects indented below their key.
std::string text_of(const Json& object, std::size_t indent) {
  std::string text;
  for (const auto& [key, value] : object.items()) {
    text += std::string(indent, ' ') + key + ":";
    text += value.is_object() ? "\n" + text_of(value, indent + 2)
                              : " " + (value.is_string() ? value.get<std::string>() : value.dump()) + "\n";
  }
  return text;
}

/// A file that cannot be read is no reason to be silent about the others: it is told at the end.
void run(const InfoOptions& options) {
  Json files = Json::array();
  std::string text;
  std::string errors;
  for (const std::string& file : options.files) {
    Json description = {{"file", file}};
    try {
      description.update(describe(file));
    } catch (const IoError& error) {
      errors += (errors.empty() ? "" : "\n") + std::string(error.what());
      description["error"] = error.what();
      files.push_back(std::move(description));
      continue;
    }
    text += file + "\n" + text_of(description, 2);
    files.push_back(std::move(description));
  }
  if (options.common.prints_tables()) fmt::print("{}", text);
  const Json document = {{"schema", "trysquare.info/1"}, {"version", TRYSQUARE_VERSION}, {"files", files}};
  write_json(options.common.json, document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  if (!errors.empty()) throw IoError(errors);
}

}  // namespace

void add_info(CLI::App& app) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App& verb = *app.add_subcommand("info", "What files hold: points, columns, extent; poses, format, path");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  add_json_option(verb, options->common);
  verb.add_option("FILE", options->files, "Scans, maps, trajectories, or folders of them")
      ->required()
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
