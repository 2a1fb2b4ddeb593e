// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"

#include "console.h"
#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>

namespace trysquare::app {

/// The options that every verb has.
struct CommonOptions {
  int num_threads = 0;
  std::uint64_t seed = 0;
  std::string json;
  std::string progress = "auto";
  std::string config;
  bool quiet = false;
  bool verbose = false;

  Execution execution() const;

  /// Result tables are for people: not with --quiet, and not when stdout carries the JSON.
  bool prints_tables() const { return !quiet && json != "-"; }
};

void add_common_options(CLI::App& verb, CommonOptions& options);

/// To the file or, for "-", to stdout; nothing when `target` is empty.
void write_json(const std::string& target, const std::string& json);

}  // namespace trysquare::app
