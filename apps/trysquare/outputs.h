// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/pipeline/evaluation.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

namespace trysquare::app {

/// Before hours of work: can this file be written, can this folder be made? Nothing is touched yet.
/// @throws IoError
void require_writable_file(const std::filesystem::path& file);
void require_possible_folder(const std::filesystem::path& folder);

/// @throws IoError
void make_folder(const std::filesystem::path& folder);

/// The direction (1, 2, 3) of every map point that is in the subset, NaN for the others. Points of an extracted subset
/// are map points and equal them to the bit.
std::vector<double> direction_of_points(const RegisteredMap& map, const OrthogonalSubset& subset);

/// Where an evaluation is written to besides the terminal; empty: nowhere.
struct OutputOptions {
  std::string directory;
  std::string report;
  std::string plots;

  /// Finds out before hours of work whether the folders can be written to; nothing is made yet.
  /// @throws IoError
  void check(const std::string& json) const;
};

void add_output_options(CLI::App& verb, OutputOptions& options);

/// Writes what the options ask for.
/// @param json         The evaluation.
/// @param as_read      Poses as they came; empty for a map.
/// @throws IoError     if a file cannot be written.
void write_outputs(const OutputOptions& options, const Evaluation& evaluation, const std::string& json,
                   const Trajectory& as_read);

}  // namespace trysquare::app
