// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"

#include "arguments.h"
#include "commands.h"
#include "console.h"
#include "exit_codes.h"
#include "interruption.h"
#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace trysquare::app {
namespace {

constexpr const char* kFooter = R"(Examples:
  trysquare evaluate sequences/00/velodyne poses.txt --report report.html
  trysquare map map.ply --radius 0.5
Each verb has its own help: trysquare evaluate --help
Exit codes: 0 ok, 2 usage, 3 unreadable or malformed input, 4 the numbers mean nothing, 5 internal error.)";

/// CLI11 2.1 reads -1 into an unsigned number as 2⁶⁴ − 1.
void refuse_negative_counts(CLI::App& app) {
  for (CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    for (CLI::Option* option : verb->get_options()) {
      if (option->get_type_name() == "UINT") option->check(CLI::NonNegativeNumber);
    }
  }
}

void declare_verbs(CLI::App& app) {
  app.set_version_flag("--version", "trysquare " TRYSQUARE_VERSION);
  app.require_subcommand(1);
  app.footer(kFooter);
  add_evaluate(app);
  add_compare(app);
  add_diagnose(app);
  add_map(app);
  add_orthogonal(app);
  add_ape(app);
  add_rpe(app);
  add_simulate(app);
  add_info(app);
  add_convert(app);
  add_refine(app);
  add_perturb(app);
  add_experiment(app);
  add_completion(app);
  refuse_negative_counts(app);
}

int run(int argc, char** argv) {
  CLI::App app("trysquare: how good is a trajectory, without ground truth? The map's own flat surfaces tell.",
               "trysquare");
  declare_verbs(app);
  try {
    std::vector<std::string> arguments = expand_arguments({argv + 1, argv + argc}, app);
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them off the end
    app.parse(std::move(arguments));
    return kOk;
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    print_error(error.what());
    std::fputs("Run trysquare --help, or a verb with --help.\n", stderr);
    return kUsage;
  } catch (const Interrupted& interrupted) {
    return std::raise(interrupted.signal);  // as if nobody had caught it: the shell is to see why
  } catch (const NotMeaningful&) {
    return kNotMeaningful;
  } catch (const InvalidArgument& error) {
    print_error(error.what());
    return kUsage;
  } catch (const IoError& error) {
    print_error(error.what());
    return kBadInput;
  }
}

}  // namespace
}  // namespace trysquare::app

int main(int argc, char** argv) {
  try {
    return trysquare::app::run(argc, argv);
  } catch (const std::bad_alloc&) {
    trysquare::app::print_error("out of memory");
  } catch (const std::exception& error) {
    trysquare::app::print_error(std::string("internal error: ") + error.what());
  }
  return trysquare::app::kInternalError;
}
