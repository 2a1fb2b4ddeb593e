// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/report/evo_result.h"
#include "trysquare/report/trajectory_figures.h"
#include "trysquare/trajectory/error_series.h"

#include <CLI/CLI.hpp>

#include <string>

namespace trysquare::app {

/// The files that `ape` and `rpe` write when asked.
struct TrajectoryOutputOptions {
  std::string evo_zip;
  std::string csv;
  std::string plots;
  std::string directory;

  bool any() const { return !evo_zip.empty() || !csv.empty() || !plots.empty() || !directory.empty(); }

  /// Before anything is computed.
  /// @throws IoError          if a place cannot be written to.
  /// @throws InvalidArgument  if PNG is asked for and nothing here can draw it.
  void check() const;
};

void add_trajectory_output_options(CLI::App& verb, TrajectoryOutputOptions& options);

/// What is known of errors that are not empty.
struct TrajectoryOutputs {
  EvoResult evo;
  ErrorSeries series;
  ComparedTrajectories compared;  ///< Empty: none go into the result file.
  std::string reference_name;     ///< As typed.
  std::string estimate_name;      ///< As typed.
};

void write_trajectory_outputs(const TrajectoryOutputOptions& options, const TrajectoryErrors& errors,
                              const Trajectory& reference, const TrajectoryOutputs& outputs);

/// The JSON, which tells of undefined errors, too, into the folder that --out names.
void write_trajectory_json(const TrajectoryOutputOptions& options, const std::string& metric, const std::string& json);

}  // namespace trysquare::app
