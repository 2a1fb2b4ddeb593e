// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/diagnostic.h"
#include "trysquare/core/execution.h"

#include "console.h"
#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>
#include <vector>

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

  /// Stdout carries the table, or the JSON instead.
  bool prints_tables() const { return json != "-"; }

  /// Warnings and notes for people, on stderr; they stand in the JSON, too.
  void warn(const std::vector<Diagnostic>& warnings) const;
  void note(const std::string& message) const;
};

void add_common_options(CLI::App& verb, CommonOptions& options);

/// --json, for verbs whose result can be told.
void add_json_option(CLI::App& verb, CommonOptions& options);

/// To the file or, for "-", to stdout; nothing when `target` is empty.
void write_json(const std::string& target, const std::string& json);

}  // namespace trysquare::app
