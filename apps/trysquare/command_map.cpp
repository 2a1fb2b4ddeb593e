// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_points.h"
#include "trysquare/pipeline/evaluate.h"
#include "trysquare/report/evaluation_json.h"

#include "commands.h"
#include "common_options.h"
#include "exit_codes.h"
#include "input_options.h"
#include "metric_options.h"
#include "outputs.h"
#include "result_table.h"
#include <fmt/format.h>

#include <memory>

namespace trysquare::app {
namespace {

constexpr const char* kFooter = R"(Examples:
  trysquare map map.ply --radius 0.5
  trysquare map map.pcd --metrics mpv,mme --out results)";

struct MapOptions {
  CommonOptions common;
  MetricOptions metric;
  OutputOptions output;
  std::string file;
};

void run(const MapOptions& options) {
  const EvaluationSettings settings = options.metric.resolve();
  options.output.check(options.common.json);
  EvaluationContext context;
  if (!options.metric.subset.empty()) context.subset = read_subset(options.metric.subset);
  const Evaluation evaluation = evaluate_map(read_map(options.file), settings, context, options.common.execution());
  const std::string json = to_json(evaluation, {.version = TRYSQUARE_VERSION, .scans = options.file});
  write_outputs(options.output, evaluation, json, {});
  options.common.warn(evaluation.warnings);
  if (options.common.prints_tables()) fmt::print("{}", evaluation_table(evaluation, may_use_color(1)));
  write_json(options.common.json, json);
  if (!evaluation.verdict.meaningful) throw NotMeaningful();
}

}  // namespace

void add_map(CLI::App& app) {
  auto options = std::make_shared<MapOptions>();
  CLI::App& verb = *app.add_subcommand("map", "MME, MPV, OMME and MOM of one registered map, without poses");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  add_json_option(verb, options->common);
  verb.add_option("FILE", options->file, "Map: PLY, PCD, XYZ, CSV, NPY or .bin")->required();
  add_metric_options(verb, options->metric);
  add_output_options(verb, options->output);
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
