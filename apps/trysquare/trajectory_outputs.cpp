// SPDX-License-Identifier: Apache-2.0
#include "trajectory_outputs.h"

#include "trysquare/io/file.h"
#include "trysquare/io/write_npy.h"
#include "trysquare/io/write_zip.h"

#include "outputs.h"

#include <filesystem>
#include <vector>

namespace trysquare::app {
namespace {

void write_evo_zip(const std::string& path, const EvoResult& result) {
  std::vector<ZipEntry> entries = {{"info.json", result.info_json}, {"stats.json", result.stats_json}};
  for (const EvoResult::Array& array : result.arrays) {
    entries.push_back({array.name + ".npy", format_npy(array.values, array.num_columns)});
  }
  write_zip(path, entries);
}

}  // namespace

void TrajectoryOutputOptions::check() const {
  if (!evo_zip.empty()) require_writable_file(evo_zip);
  if (!csv.empty()) require_writable_file(csv);
  if (!plots.empty()) require_possible_folder(plots);
}

void add_trajectory_output_options(CLI::App& verb, TrajectoryOutputOptions& options) {
  const std::string group = "Outputs";
  verb.add_option("--save-results", options.evo_zip, "Write a result file of evo (.zip), which evo_res opens")
      ->group(group);
  verb.add_option("--csv", options.csv, "Write every error with its time and place into this file")->group(group);
  verb.add_option(
          "--plot", options.plots,
          "Write figures as SVG into this folder: the trajectory colored by error, errors over time and distance")
      ->group(group);
}

void write_trajectory_outputs(const TrajectoryOutputOptions& options, const TrajectoryErrors& errors,
                              const ErrorSeries& series, const Trajectory& reference, const EvoResult& evo) {
  if (!options.evo_zip.empty()) write_evo_zip(options.evo_zip, evo);
  if (!options.csv.empty()) write_file(options.csv, errors_csv(errors, series));
  if (options.plots.empty()) return;
  make_folder(options.plots);
  for (const Figure& figure : error_figures(errors, series, reference)) {
    write_file(std::filesystem::path(options.plots) / figure.file_name, figure.svg);
  }
}

}  // namespace trysquare::app
