// SPDX-License-Identifier: Apache-2.0
#include "outputs.h"

#include "trysquare/core/error.h"
#include "trysquare/io/file.h"
#include "trysquare/io/write_ply.h"
#include "trysquare/io/write_trajectory.h"
#include "trysquare/report/evaluation_csv.h"
#include "trysquare/report/evaluation_figures.h"
#include "trysquare/report/evaluation_html.h"

#include "figure_files.h"
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace trysquare::app {
namespace {

namespace fs = std::filesystem;

void require_writable_folder(const fs::path& folder) {
  const fs::path where = folder.empty() ? fs::path(".") : folder;
  std::error_code ignored;
  if (!fs::is_directory(where, ignored)) throw IoError(where.string() + ": not a folder, cannot write into it");
  if (access(where.c_str(), W_OK) != 0) throw IoError(where.string() + ": the folder cannot be written to");
}

using Coordinates = std::tuple<double, double, double>;

Coordinates coordinates_of(const Eigen::Vector3d& point) { return {point.x(), point.y(), point.z()}; }

/// Values of the queries at their map points, NaN elsewhere.
template <class Values>
PointTable::Column column(const std::string& name, const Evaluation& evaluation, const Values& values) {
  PointTable::Column result{
      name, std::vector<double>(evaluation.map.points_in_map.size(), std::numeric_limits<double>::quiet_NaN())};
  for (std::size_t i = 0; i < evaluation.query_indices.size(); ++i) {
    result.values[evaluation.query_indices[i]] = static_cast<double>(values[i]);
  }
  return result;
}

PointTable map_table(const Evaluation& evaluation) {
  const PointStatistics& statistics = evaluation.query_statistics;
  const std::vector<std::uint32_t>& scans = evaluation.map.scan_of_point;
  return {evaluation.map.points_in_map,
          {column("plane_variance", evaluation, statistics.plane_variances),
           column("entropy", evaluation, statistics.entropies),
           {"scan", std::vector<double>(scans.begin(), scans.end())},
           column("num_neighbors", evaluation, statistics.num_neighbors),
           {"direction", direction_of_points(evaluation.map, evaluation.subset)}}};
}

void write_directory(const fs::path& folder, const Evaluation& evaluation, const std::string& json,
                     const Trajectory& as_read) {
  write_file(folder / "evaluation.json", json);
  write_file(folder / "windows.csv", windows_csv(json));
  write_file(folder / "poses.csv", poses_csv(json));
  write_ply(folder / "map.ply", map_table(evaluation));
  if (as_read.size() > 0) write_trajectory(folder / "trajectory.tum", as_read, TrajectoryFormat::kTum);
}

}  // namespace

std::vector<double> direction_of_points(const RegisteredMap& map, const OrthogonalSubset& subset) {
  std::vector<std::pair<Coordinates, double>> directions;
  for (std::size_t i = 0; i < subset.directions.size(); ++i) {
    for (const Eigen::Vector3d& point : subset.directions[i].points_in_map) {
      directions.emplace_back(coordinates_of(point), static_cast<double>(i + 1));
    }
  }
  std::sort(directions.begin(), directions.end());
  std::vector<double> result(map.points_in_map.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Coordinates point = coordinates_of(map.points_in_map[i]);
    const auto found = std::lower_bound(directions.begin(), directions.end(), std::pair(point, 0.0));
    if (found != directions.end() && found->first == point) result[i] = found->second;
  }
  return result;
}

void require_writable_file(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) throw IoError(file.string() + ": cannot be written: it is a folder");
  try {
    require_writable_folder(file.parent_path());
  } catch (const IoError& error) {
    throw IoError(fmt::format("{}: cannot be written: {}", file.string(), error.what()));
  }
}

void require_possible_folder(const fs::path& folder) {
  fs::path existing = fs::absolute(folder);
  std::error_code ignored;
  while (!fs::exists(existing, ignored) && existing.has_relative_path()) existing = existing.parent_path();
  require_writable_folder(existing);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw IoError(fmt::format("{}: cannot make the folder: {}", folder.string(), error.message()));
  require_writable_folder(folder);
}

void OutputOptions::check(const std::string& json) const {
  if (!json.empty() && json != "-") require_writable_file(json);
  if (!report.empty()) require_writable_file(report);
  if (!directory.empty()) require_possible_folder(directory);
  if (!plots.empty()) check_place_of_figures(plots);
}

void add_output_options(CLI::App& verb, OutputOptions& options) {
  const std::string group = "Outputs";
  verb.add_option("--out", options.directory,
                  "Write evaluation.json, windows.csv, poses.csv, map.ply and trajectory.tum into this folder")
      ->group(group);
  verb.add_option("--report", options.report, "Write the report as one self-contained HTML file")->group(group);
  verb.add_option("--plot", options.plots, std::string("Write the figures of the report ") + kFiguresHelp)
      ->group(group);
}

void write_outputs(const OutputOptions& options, const Evaluation& evaluation, const std::string& json,
                   const Trajectory& as_read) {
  if (!options.directory.empty()) {
    make_folder(options.directory);
    write_directory(options.directory, evaluation, json, as_read);
  }
  if (!options.report.empty()) write_file(options.report, to_html(json));
  if (!options.plots.empty()) write_figures(options.plots, figures(json));
}

}  // namespace trysquare::app
