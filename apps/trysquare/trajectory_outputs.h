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

  bool any() const { return !evo_zip.empty() || !csv.empty() || !plots.empty(); }

  /// Before anything is computed. @throws IoError  if a place cannot be written to.
  void check() const;
};

void add_trajectory_output_options(CLI::App& verb, TrajectoryOutputOptions& options);

/// @param evo  REQUIRES: errors that are not empty.
void write_trajectory_outputs(const TrajectoryOutputOptions& options, const TrajectoryErrors& errors,
                              const ErrorSeries& series, const Trajectory& reference, const EvoResult& evo);

}  // namespace trysquare::app
