// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/io/write_ply.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/metrics/extract_orthogonal_subset.h"
#include "trysquare/report/orthogonal_json.h"

#include "commands.h"
#include "common_options.h"
#include "exit_codes.h"
#include "inputs.h"
#include "metric_options.h"
#include "outputs.h"
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace trysquare::app {
namespace {

constexpr const char* kFooter = R"(Examples:
  trysquare orthogonal sequences/00/velodyne sequences/00/poses.txt --last 9
  trysquare orthogonal scan.pcd --radius 0.2 --out results)";

struct OrthogonalOptions {
  CommonOptions common;
  InputOptions input;
  MetricOptions metric;
  std::string directory;
};

struct LoadedMap {
  RegisteredMap map;
  std::optional<std::string> extrinsic;
};

LoadedMap load_map(const OrthogonalOptions& options, const Execution& execution) {
  if (!options.input.poses.empty()) {
    const Inputs inputs = load_inputs(options.input);
    options.common.warn(inputs.warnings);
    return {assemble_map(*inputs.scans, inputs.world_from_scan, {}, execution).map,
            inputs.extrinsic ? std::optional(inputs.extrinsic->description) : std::nullopt};
  }
  const std::unique_ptr<ScanSequence> scans = load_scans(options.input);
  if (scans->size() != 1) {
    throw InvalidArgument(fmt::format("{} scans without poses: give POSES, or one scan", scans->size()));
  }
  return {assemble_map(*scans, {.world_from_scan = std::vector<Pose>(1)}, {}, execution).map, std::nullopt};
}

std::string table_of(const OrthogonalSubsetResult& result) {
  std::string text = fmt::format("{} points looked at, {} planar, {} clusters of normals\n\n", result.num_points,
                                 result.num_planar, result.num_clusters);
  for (std::size_t i = 0; i < result.subset.directions.size(); ++i) {
    const OrthogonalSubset::Direction& direction = result.subset.directions[i];
    text += fmt::format("  direction {}: {:6} points, normal [{:8.5f} {:8.5f} {:8.5f}]\n", i + 1,
                        direction.points_in_map.size(), direction.normal_in_map.x(), direction.normal_in_map.y(),
                        direction.normal_in_map.z());
  }
  if (!result.reason.empty()) text += "  " + result.reason + "\n";
  return text;
}

/// Points of the subset with their direction (1, 2, 3) as a scalar, which CloudCompare colors.
PointTable points_of(const OrthogonalSubset& subset) {
  PointTable table{.columns = {{"direction", {}}}};
  for (std::size_t i = 0; i < subset.directions.size(); ++i) {
    const std::vector<Eigen::Vector3d>& points = subset.directions[i].points_in_map;
    table.points.insert(table.points.end(), points.begin(), points.end());
    table.columns[0].values.resize(table.points.size(), static_cast<double>(i + 1));
  }
  return table;
}

void run(const OrthogonalOptions& options) {
  const EvaluationSettings settings = options.metric.resolve();
  if (!options.common.json.empty() && options.common.json != "-") require_writable_file(options.common.json);
  if (!options.directory.empty()) require_possible_folder(options.directory);
  const LoadedMap loaded = load_map(options, options.common.execution());
  const OrthogonalSubsetResult result =
      extract_orthogonal_subset(loaded.map, settings.radius_m, settings.orthogonal, options.common.execution());
  const std::string json =
      to_json(result, settings.orthogonal,
              {.version = TRYSQUARE_VERSION,
               .scans = options.input.scans,
               .poses = options.input.poses.empty() ? std::nullopt : std::optional(options.input.poses),
               .extrinsic = loaded.extrinsic,
               .radius_m = settings.radius_m,
               .num_scans = loaded.map.num_scans});
  if (!options.directory.empty()) {
    make_folder(options.directory);
    write_json((std::filesystem::path(options.directory) / "orthogonal.json").string(), json);
    write_ply(std::filesystem::path(options.directory) / "orthogonal.ply", points_of(result.subset));
  }
  if (options.common.prints_tables()) fmt::print("{}", table_of(result));
  write_json(options.common.json, json);
  if (result.subset.directions.empty()) throw NotMeaningful();
}

}  // namespace

void add_orthogonal(CLI::App& app) {
  auto options = std::make_shared<OrthogonalOptions>();
  CLI::App& verb = *app.add_subcommand("orthogonal", "The mutually orthogonal surfaces that MOM and OMME look at");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  add_json_option(verb, options->common);
  verb.add_option("SCANS", options->input.scans, "Scans: folder, quoted pattern, KITTI sequence, or one file")
      ->required();
  verb.add_option("POSES", options->input.poses, "Poses; not needed for one scan");
  add_orthogonal_options(verb, options->metric);
  add_scan_options(verb, options->input);
  add_pose_options(verb, options->input);
  verb.add_option("--out", options->directory, "Write orthogonal.json and orthogonal.ply into this folder")
      ->group("Outputs");
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
