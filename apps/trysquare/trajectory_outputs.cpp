// SPDX-License-Identifier: Apache-2.0
#include "trajectory_outputs.h"

#include "trysquare/io/file.h"
#include "trysquare/io/write_npy.h"
#include "trysquare/io/write_trajectory.h"
#include "trysquare/io/write_zip.h"

#include "figure_files.h"
#include "outputs.h"

#include <filesystem>
#include <vector>

namespace trysquare::app {
namespace {

namespace fs = std::filesystem;

/// Under the names of their files, as evo has them; TUM when there are time stamps, else KITTI.
void add_trajectories(std::vector<ZipEntry>& entries, const TrajectoryOutputs& outputs) {
  const auto& [reference, estimate] = outputs.compared;
  if (estimate.size() == 0) return;
  std::string reference_name = fs::path(outputs.reference_name).filename().string();
  std::string estimate_name = fs::path(outputs.estimate_name).filename().string();
  if (reference_name == estimate_name) {
    reference_name = "reference_" + reference_name;
    estimate_name = "estimate_" + estimate_name;
  }
  const bool has_time = !reference.stamps_ns.empty() && !estimate.stamps_ns.empty();
  const TrajectoryFormat format = has_time ? TrajectoryFormat::kTum : TrajectoryFormat::kKitti;
  const std::string ending = has_time ? ".tum" : ".kitti";
  entries.push_back({reference_name + ending, format_trajectory(reference, format)});
  entries.push_back({estimate_name + ending, format_trajectory(estimate, format)});
}

void write_evo_zip(const fs::path& path, const TrajectoryOutputs& outputs) {
  std::vector<ZipEntry> entries = {{"info.json", outputs.evo.info_json}, {"stats.json", outputs.evo.stats_json}};
  for (const EvoResult::Array& array : outputs.evo.arrays) {
    entries.push_back({array.name + ".npy", format_npy(array.values, array.num_columns)});
  }
  add_trajectories(entries, outputs);
  write_zip(path, entries);
}

}  // namespace

void TrajectoryOutputOptions::check() const {
  if (!evo_zip.empty()) require_writable_file(evo_zip);
  if (!csv.empty()) require_writable_file(csv);
  if (!plots.empty()) check_place_of_figures(plots);
  if (!directory.empty()) require_possible_folder(directory);
}

void add_trajectory_output_options(CLI::App& verb, TrajectoryOutputOptions& options) {
  const std::string group = "Outputs";
  verb.add_option("--out", options.directory,
                  "Write JSON, CSV, a result file of evo and the figures as SVG into this folder")
      ->group(group);
  verb.add_option("--save-results", options.evo_zip, "Write a result file of evo (.zip), which evo_res opens")
      ->group(group);
  verb.add_option("--csv", options.csv, "Write every error with its time and place into this file")->group(group);
  verb.add_option(
          "--plot,--save-plot", options.plots,
          std::string("Write the trajectory colored by error, and errors over time and distance, ") + kFiguresHelp)
      ->group(group);
}

void write_trajectory_outputs(const TrajectoryOutputOptions& options, const TrajectoryErrors& errors,
                              const Trajectory& reference, const TrajectoryOutputs& outputs) {
  const std::string metric = errors.pairs.empty() ? "ape" : "rpe";
  if (!options.evo_zip.empty()) write_evo_zip(options.evo_zip, outputs);
  if (!options.csv.empty()) write_file(options.csv, errors_csv(errors, outputs.series));
  if (!options.plots.empty()) write_figures(options.plots, error_figures(errors, outputs.series, reference));
  if (options.directory.empty()) return;
  const fs::path folder = options.directory;
  make_folder(folder);
  write_evo_zip(folder / (metric + ".zip"), outputs);
  write_file(folder / (metric + ".csv"), errors_csv(errors, outputs.series));
  write_figures((folder / (metric + ".svg")).string(), error_figures(errors, outputs.series, reference));
}

void write_trajectory_json(const TrajectoryOutputOptions& options, const std::string& metric, const std::string& json) {
  if (options.directory.empty()) return;
  make_folder(options.directory);
  write_file(fs::path(options.directory) / (metric + ".json"), json);
}

}  // namespace trysquare::app
