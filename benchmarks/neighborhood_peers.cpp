// SPDX-License-Identifier: Apache-2.0
#include "peers.h"
#include "problem.h"
#include "process_usage.h"
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace trysquare::bench {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::string engine;
  std::filesystem::path map;
  double radius_m = 1.0;
  int num_threads = 1;
  QuerySettings queries;
};

const Engine& engine_named(const std::string& name) {
  const auto found = std::ranges::find(engines(), name, &Engine::name);
  if (found == engines().end()) throw std::runtime_error("no engine '" + name + "' here, see --list");
  return *found;
}

Json list_of_engines() {
  Json versions;
  for (const Engine& engine : engines()) versions[engine.name] = engine.version;
  return {{"engines", versions}, {"compiler", TRYSQUARE_BENCH_COMPILER}, {"flags", TRYSQUARE_BENCH_FLAGS}};
}

Json value_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json report(const Arguments& arguments, const Problem& problem, const Outcome& outcome, std::uint64_t rss_before) {
  const std::size_t num_queries = problem.queries_in_map().size();
  return {{"engine", arguments.engine},
          {"num_points", problem.points_in_map.size()},
          {"num_scans", problem.num_scans},
          {"num_queries", num_queries},
          {"every", arguments.queries.every},
          {"fixed_scan0", arguments.queries.fixed_scan0},
          {"radius_m", problem.radius_m},
          {"threads", problem.num_threads},
          {"build_user_s", outcome.build.user_s},
          {"build_system_s", outcome.build.system_s},
          {"query_user_s", outcome.query.user_s},
          {"query_system_s", outcome.query.system_s},
          {"wall_s", outcome.build.wall_s + outcome.query.wall_s},
          {"neighbors_mean", static_cast<double>(outcome.neighbors_sum) / static_cast<double>(num_queries)},
          {"neighbors_sum", outcome.neighbors_sum},
          {"mpv", value_or_null(outcome.mpv)},
          {"mme", value_or_null(outcome.mme)},
          {"rss_before_bytes", rss_before},
          {"peak_rss_bytes", peak_resident_bytes()}};
}

Json measure(const Arguments& arguments) {
  const Engine& engine = engine_named(arguments.engine);
  if (arguments.num_threads != 1 && !engine.uses_threads) {
    throw std::runtime_error(arguments.engine + " runs in one thread: --threads 1");
  }
  Problem problem = read_problem(arguments.map, arguments.queries);
  if (problem.queries_in_map().empty()) throw std::runtime_error("these settings leave no query");
  problem.radius_m = arguments.radius_m;
  problem.num_threads = arguments.num_threads;
  const std::uint64_t rss_before = resident_bytes();
  const Outcome outcome = engine.run(problem);
  return report(arguments, problem, outcome, rss_before);
}

}  // namespace
}  // namespace trysquare::bench

/// Runs one engine once, in a process of its own so that its peak memory is its own, and prints one line of JSON.
int main(int argc, char** argv) {
  using trysquare::bench::list_of_engines;
  trysquare::bench::Arguments arguments;
  bool list = false;
  CLI::App app("Neighborhoods of a map by one engine: time, memory and values as one line of JSON");
  app.add_flag("--list", list, "print the engines of this program and their versions");
  app.add_option("--engine", arguments.engine, "which one");
  app.add_option("--map", arguments.map, "float64 records x, y, z, scan, in scan order");
  app.add_option("--radius", arguments.radius_m, "[m]")->check(CLI::PositiveNumber);
  app.add_option("--every", arguments.queries.every, "queries: one block of 64 points out of K; 1: all points")
      ->check(CLI::PositiveNumber);
  app.add_flag("--fixed-scan0", arguments.queries.fixed_scan0, "queries: points of scan 0 only");
  app.add_option("--threads", arguments.num_threads, "threads")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    std::puts((list ? list_of_engines() : trysquare::bench::measure(arguments)).dump().c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  return 0;
}
