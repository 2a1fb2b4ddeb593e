// SPDX-License-Identifier: Apache-2.0
#include "common_options.h"

#include "trysquare/io/file.h"

#include <cstdio>

namespace trysquare::app {

Execution CommonOptions::execution() const {
  ProgressMode mode = ProgressMode::kAuto;
  if (progress == "always") mode = ProgressMode::kAlways;
  if (progress == "never" || (quiet && progress == "auto")) mode = ProgressMode::kNever;
  return {.num_threads = num_threads, .progress = progress_bar(mode)};
}

void CommonOptions::warn(const std::vector<Diagnostic>& warnings) const {
  if (!quiet) print_warnings(warnings);
}

void CommonOptions::note(const std::string& message) const {
  if (!quiet) print_note(message);
}

void add_common_options(CLI::App& verb, CommonOptions& options) {
  const std::string group = "Common options";
  verb.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  verb.add_option("--threads", options.num_threads, "Threads; 0: all cores. The results do not depend on it")
      ->capture_default_str()
      ->group(group);
  verb.add_option("--seed", options.seed, "Seed of random numbers, where a verb draws any")
      ->capture_default_str()
      ->group(group);
  verb.add_option("--progress", options.progress, "Show progress on stderr")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->capture_default_str()
      ->group(group);
  verb.add_flag("--quiet,-q", options.quiet, "Print errors and results only: no warnings, no notes, no progress")
      ->group(group);
  verb.add_flag("--verbose", options.verbose, "Say on stderr what is read and written")->group(group);
  verb.add_option("--config", options.config, "TOML file with option names as keys; the command line wins")
      ->group(group);
}

void add_json_option(CLI::App& verb, CommonOptions& options) {
  verb.add_option("--json", options.json, "Write the result as JSON to this file, or to stdout for -")
      ->group("Common options");
}

void write_json(const std::string& target, const std::string& json) {
  if (target.empty()) return;
  if (target == "-") {
    std::fwrite(json.data(), 1, json.size(), stdout);
  } else {
    write_file(target, json);
  }
}

}  // namespace trysquare::app
