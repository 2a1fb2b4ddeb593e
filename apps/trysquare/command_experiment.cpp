// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/experiments/experiment.h"
#include "trysquare/experiments/simulated_drive.h"
#include "trysquare/io/file.h"
#include "trysquare/parallel/for_each_block.h"
#include "trysquare/report/experiment_figures.h"
#include "trysquare/report/experiment_json.h"
#include "trysquare/report/orthogonal_figures.h"
#include "trysquare/report/orthogonal_json.h"

#include "commands.h"
#include "common_options.h"
#include "experiment_store.h"
#include "input_options.h"
#include "outputs.h"
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trysquare::app {
namespace {

namespace fs = std::filesystem;

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

constexpr const char* kFooter = R"(Examples:
  trysquare experiment counterexample --out results
  trysquare experiment paper --out results
  trysquare experiment planes --environments 10 --trajectories 100 --lengths 5,15 --out results/small
  trysquare experiment kitti --data sequences/00/velodyne --poses adjusted.txt --out results/kitti
Perturbs the true poses of each environment many times and says how well each metric follows the paper's RPE. Finished
studies stay in OUT/samples: after an interruption the same call goes on where it was.
paper: all experiments that need no data, each in a folder of its own, and kitti where --data is given.)";

/// What was asked for; empty members: as the experiment has it by default.
struct ExperimentOptions {
  CommonOptions common;
  InputOptions input;
  std::string experiment;
  std::string directory;
  std::optional<std::size_t> num_environments;
  std::optional<std::size_t> num_trajectories;
  std::vector<std::size_t> lengths;
  std::vector<double> rotations_deg;
  std::optional<double> translation_m;
  std::optional<double> radius_m;
  std::optional<std::size_t> num_queries;
  std::optional<std::size_t> num_points_per_direction;
  std::size_t num_sequence_scans = 300;
  std::string model = "white";
  std::string intervals = "bootstrap";

  ExperimentSettings settings(ExperimentKind kind) const {
    ExperimentSettings result = default_experiment(kind);
    if (num_environments) result.num_environments = *num_environments;
    if (num_trajectories) result.num_trajectories = *num_trajectories;
    if (!lengths.empty()) result.num_poses = lengths;
    if (!rotations_deg.empty()) {
      result.rotation_sigmas_rad.clear();
      for (const double sigma_deg : rotations_deg) result.rotation_sigmas_rad.push_back(sigma_deg * kRadiansPerDegree);
    }
    if (translation_m) result.translation_sigma_m = *translation_m;
    if (radius_m) result.radius_m = *radius_m;
    if (num_queries) result.scene.num_queries = *num_queries;
    if (num_points_per_direction) result.scene.num_points_per_direction = *num_points_per_direction;
    result.noise_model = *noise_model_named(model);
    result.intervals = intervals == "fisher" ? IntervalMethod::kFisher : IntervalMethod::kBootstrap;
    result.seed = common.seed;
    result.validate();
    return result;
  }
};

/// Experiments that `experiment paper` runs.
std::vector<ExperimentKind> kinds_of(const ExperimentOptions& options) {
  constexpr std::array kAll = {ExperimentKind::kCounterexample, ExperimentKind::kPlanes, ExperimentKind::kStreet,
                               ExperimentKind::kTown, ExperimentKind::kScans};
  std::vector<ExperimentKind> kinds;
  for (const ExperimentKind kind : kAll) {
    const bool is_possible = kind != ExperimentKind::kScans || !options.input.scans.empty();
    if (options.experiment == name_of(kind) || (options.experiment == "paper" && is_possible)) kinds.push_back(kind);
  }
  return kinds;
}

/// Every study, finished before or now.
std::vector<MetricSamples> run_units(const ExperimentOptions& options, const ExperimentSettings& settings,
                                     const std::vector<ExperimentUnit>& units, const ExperimentStore& store,
                                     const ExperimentData& data) {
  const Execution execution = options.common.execution();
  const Execution quiet{.num_threads = execution.num_threads};
  std::vector<MetricSamples> all;
  std::size_t num_found = 0;
  for (const ExperimentUnit& unit : units) {
    std::optional<MetricSamples> samples = store.load(unit, settings.num_trajectories);
    if (samples) {
      ++num_found;
    } else {
      samples = run_unit(settings, unit, data, quiet);
      store.save(unit, *samples);
    }
    all.push_back(std::move(*samples));
    if (execution.progress) execution.progress("studies", all.size(), units.size());
  }
  if (num_found > 0) options.common.note(fmt::format("{} of {} studies were finished before", num_found, units.size()));
  return all;
}

std::string table_of(const ExperimentSettings& settings, const std::vector<GroupSummary>& groups) {
  std::string text = fmt::format("{}: {} environments × {} trajectories; correlation with the paper's RPE\n",
                                 name_of(settings.kind), settings.num_environments, settings.num_trajectories);
  for (const GroupSummary& group : groups) {
    text += fmt::format("\n{}, {} poses, {:.4g}° rotation noise\n  {:26}{:>10}{:>18}{:>10}{:>10}\n", group.group,
                        group.num_poses, group.rotation_sigma_rad / kRadiansPerDegree, "", "Pearson", "[95 % of mean]",
                        "Spearman", "Kendall");
    for (const MetricSummary& metric : group.metrics) {
      text += fmt::format("  {:26}", metric.metric);
      for (std::size_t c = 0; c < metric.coefficients.size(); ++c) {
        const CoefficientSummary& summary = metric.coefficients.at(c);
        text += summary.mean ? fmt::format("{:10.4f}", *summary.mean) : fmt::format("{:>10}", "undefined");
        if (c > 0) continue;
        text += fmt::format("{:>18}", summary.mean_interval ? fmt::format("[{:.4f} {:.4f}]", summary.mean_interval->low,
                                                                          summary.mean_interval->high)
                                                            : "");
      }
      text += '\n';
    }
  }
  return text + '\n';
}

/// The first environment of every scene and size of noise, at the middle number of poses.
std::vector<ScatterRow> scatter_rows(const ExperimentSettings& settings, const std::vector<ExperimentUnit>& units,
                                     const std::vector<MetricSamples>& samples) {
  std::vector<ScatterRow> rows;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const ExperimentUnit& unit = units[i];
    if (unit.environment != 0 || unit.num_poses != settings.num_poses[(settings.num_poses.size() - 1) / 2]) continue;
    rows.push_back({fmt::format("{}, {} poses, {:.4g}° rotation noise", unit.group, unit.num_poses,
                                unit.rotation_sigma_rad / kRadiansPerDegree),
                    samples[i]});
  }
  return rows;
}

/// The orthogonal subset of every scan of a long drive through every town, by the product's method and the paper's.
/// What is there already is kept.
void write_extractions(const ExperimentOptions& options, const ExperimentSettings& settings, const fs::path& folder) {
  make_folder(folder / "extraction");
  for (const std::string_view town : kSimulatedTowns) {
    for (const SubsetMethod method : {SubsetMethod::kPatches, SubsetMethod::kPaper}) {
      const std::string name = fmt::format("{}-{}-{}", town, name_of(method), options.num_sequence_scans);
      const fs::path file = folder / "extraction" / (name + ".json");
      std::error_code ignored;
      if (fs::exists(file, ignored)) continue;
      const OrthogonalSubsetSettings extraction{.method = method};
      const std::vector<OrthogonalWindow> windows = extraction_along_drive(
          town, settings.seed, options.num_sequence_scans, settings.radius_m, extraction, options.common.execution());
      const std::string json = to_json({.reason = "every scan is looked at by itself: see windows"}, extraction,
                                       {.version = TRYSQUARE_VERSION,
                                        .scans = fmt::format("simulated: {}, seed {}", town, settings.seed),
                                        .radius_m = settings.radius_m,
                                        .num_scans = options.num_sequence_scans},
                                       windows);
      write_file(folder / "extraction" / (name + ".csv"), orthogonal_windows_csv(json));
      write_file(folder / "extraction" / (name + ".svg"), orthogonal_windows_figure(json).svg);
      write_file(file, json);  // last: its presence says that the others are there
    }
  }
}

void run_experiment(const ExperimentOptions& options, ExperimentKind kind, const fs::path& folder,
                    const ExperimentData& data) {
  const ExperimentSettings settings = options.settings(kind);
  ExperimentFacts facts{.version = TRYSQUARE_VERSION};
  if (kind == ExperimentKind::kScans) {
    facts.scans = options.input.scans;
    facts.poses = options.input.poses;
  }
  const std::vector<ExperimentUnit> units = experiment_units(settings);
  const ExperimentStore store(folder, settings_json(settings, facts));
  const std::vector<MetricSamples> samples = run_units(options, settings, units, store, data);
  std::vector<std::vector<MetricCorrelation>> correlations(units.size());
  for_each_block(units.size(), 1, options.common.execution(), "intervals", [&](const Block& block) {
    correlations[block.index] = correlations_of(settings, units[block.index], samples[block.index]);
  });
  const std::vector<GroupSummary> groups = summarize(settings, units, correlations);
  const std::string json = to_json(settings, groups, facts);
  write_file(folder / "experiment.json", json);
  write_file(folder / "correlations.csv", correlations_csv(units, correlations));
  write_file(folder / "summary.csv", summary_csv(groups));
  for (const Figure& figure :
       {correlations_figure(units, correlations), scatter_figure(scatter_rows(settings, units, samples))}) {
    write_file(folder / figure.file_name, figure.svg);
  }
  if (options.common.prints_tables()) fmt::print("{}", table_of(settings, groups));
  write_json(options.common.json, json);
  if (kind == ExperimentKind::kTown && options.num_sequence_scans > 0) write_extractions(options, settings, folder);
}

/// Environments are runs of scans that do not overlap.
void require_enough_scans(const ExperimentSettings& settings, std::size_t num_scans) {
  const std::size_t needed = settings.num_environments * settings.num_poses.back();
  if (needed <= num_scans) return;
  throw InvalidArgument(
      fmt::format("{} environments of {} scans need {} scans, but --data has {}: ask for fewer with "
                  "--environments or --lengths",
                  settings.num_environments, settings.num_poses.back(), needed, num_scans));
}

void run(const ExperimentOptions& options) {
  const std::vector<ExperimentKind> kinds = kinds_of(options);
  for (const ExperimentKind kind : kinds) options.settings(kind);  // before anything is computed
  if (kinds.size() > 1 && !options.common.json.empty()) {
    throw InvalidArgument("--json is for one experiment; each of `paper` has its experiment.json in OUT");
  }
  if (options.experiment == "kitti" && options.input.scans.empty()) {
    throw InvalidArgument("experiment kitti needs --data SCANS and --poses POSES");
  }
  if (options.input.scans.empty() != options.input.poses.empty()) {
    throw InvalidArgument("--data and --poses belong together: one of them is missing");
  }
  if (!options.common.json.empty() && options.common.json != "-") require_writable_file(options.common.json);
  require_possible_folder(options.directory);
  std::optional<Inputs> inputs;
  if (!options.input.scans.empty()) {
    inputs = load_inputs(options.input);
    options.common.warn(inputs->warnings);
    require_enough_scans(options.settings(ExperimentKind::kScans), inputs->scans->size());
  }
  for (const ExperimentKind kind : kinds) {
    ExperimentData data;
    if (kind == ExperimentKind::kScans) data = {inputs->scans.get(), &inputs->world_from_scan};
    const fs::path folder(options.directory);
    run_experiment(options, kind, options.experiment == "paper" ? folder / name_of(kind) : folder, data);
  }
}

}  // namespace

void add_experiment(CLI::App& app) {
  auto options = std::make_shared<ExperimentOptions>();
  CLI::App& verb = *app.add_subcommand("experiment", "The paper's experiments: do the metrics follow the RPE?");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  add_json_option(verb, options->common);
  verb.add_option("EXPERIMENT", options->experiment, "Which one, or paper for all")
      ->required()
      ->check(CLI::IsMember({"counterexample", "planes", "street", "town", "kitti", "paper"}));
  verb.add_option("--out", options->directory, "Folder of the results, and of what is finished")->required();
  verb.add_option("--environments", options->num_environments, "Scenes of every kind");
  verb.add_option("--trajectories", options->num_trajectories, "Perturbed trajectories of every study");
  verb.add_option("--lengths", options->lengths, "Numbers of poses, ascending: 5,15,30")->delimiter(',');
  verb.add_option("--translation", options->translation_m, "Translation noise per axis [m]");
  verb.add_option("--rotation", options->rotations_deg, "Rotation noise per axis [degrees], one or several: 0.02,0.2")
      ->delimiter(',');
  verb.add_option("--model", options->model, "white: errors of poses; walk: errors of steps, which add up")
      ->check(CLI::IsMember({"white", "walk"}))
      ->capture_default_str();
  verb.add_option("--radius", options->radius_m, "Of the neighborhoods [m]");
  verb.add_option("--queries", options->num_queries, "Query points of MME and MPV, at least");
  verb.add_option("--orthogonal-points", options->num_points_per_direction, "Query points of a direction, at most");
  verb.add_option("--sequence", options->num_sequence_scans,
                  "Scans of the drives along which town looks at the orthogonal subset, scan by scan; 0: none")
      ->capture_default_str();
  verb.add_option("--intervals", options->intervals, "How intervals are made")
      ->check(CLI::IsMember({"bootstrap", "fisher"}))
      ->capture_default_str();
  verb.add_option("--data", options->input.scans, "Scans of kitti: folder, quoted pattern, or data set");
  verb.add_option("--poses", options->input.poses, "Their true poses");
  add_pose_options(verb, options->input);
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
