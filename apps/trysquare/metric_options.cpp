// SPDX-License-Identifier: Apache-2.0
#include "metric_options.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

#include <sstream>
#include <vector>

namespace trysquare::app {
namespace {

std::vector<Metric> metrics_named(const std::string& list) {
  if (list == "all") return EvaluationSettings{}.metrics;
  std::vector<Metric> metrics;
  std::istringstream names(list);
  for (std::string name; std::getline(names, name, ',');) {
    const std::optional<Metric> metric = metric_named(name);
    if (!metric) {
      throw InvalidArgument(
          fmt::format("--metrics: unknown metric '{}': known are mme, mpv, omme, mom, rpe, all", name));
    }
    metrics.push_back(*metric);
  }
  return metrics;
}

void add_neighborhood_options(CLI::App& verb, MetricOptions& options) {
  const std::string group = "Metric options";
  verb.add_option("--radius", options.radius_m, "Radius of the neighborhoods [m]; else the preset's")->group(group);
  verb.add_option("--preset", options.preset,
                  "lidar: radius 1.0 m; depth: radius 0.2 m, and patches of a fifth for the RPE estimate")
      ->check(CLI::IsMember({"lidar", "depth"}))
      ->capture_default_str()
      ->group(group);
  verb.add_option("--subset-method", options.subset_method,
                  "How orthogonal surfaces are found: planar patches, the paper's clusters, or map-metrics' own")
      ->check(CLI::IsMember({"patches", "paper", "map-metrics"}))
      ->capture_default_str()
      ->group(group);
  verb.add_option(
          "--subset-scans", options.settings.orthogonal.num_scans,
          fmt::format("Look for orthogonal surfaces in this many scans, evenly spread; default {} for patches, "
                      "{} for the others",
                      OrthogonalSubsetSettings{}.for_patches().patches.num_scans, ClusterSubsetSettings{}.num_scans))
      ->group(group);
  verb.add_flag("--no-colinear", options.no_colinear,
                "Method paper: leave clusters out that are co-linear with a direction")
      ->group(group);
}

}  // namespace

EvaluationSettings MetricOptions::resolve() const {
  EvaluationSettings result = settings;
  if (result.orthogonal.num_scans == 0U) {
    throw InvalidArgument("--subset-scans 0 is out of range: it must be at least 1");
  }
  result.metrics = metrics_named(metrics);
  result.definition = *definition_named(definition);
  const EvaluationSettings of_preset = preset == "depth" ? EvaluationSettings::room_scale() : EvaluationSettings{};
  result.radius_m = radius_m.value_or(of_preset.radius_m);
  result.adjustment = of_preset.adjustment;
  if (min_neighbors) {
    result.min_neighbors = *min_neighbors;
    result.min_neighbors_orthogonal = *min_neighbors;
  }
  result.orthogonal.method = *subset_method_named(subset_method);
  result.orthogonal.join_colinear = !no_colinear;
  result.validate();
  return result;
}

void add_orthogonal_options(CLI::App& verb, MetricOptions& options) { add_neighborhood_options(verb, options); }

void add_metric_options(CLI::App& verb, MetricOptions& options) {
  const std::string group = "Metric options";
  verb.add_option("--metrics", options.metrics, "Comma list of mme, mpv, omme, mom, rpe; or all")
      ->capture_default_str()
      ->group(group);
  add_neighborhood_options(verb, options);
  verb.add_option(
          "--min-neighbors", options.min_neighbors,
          fmt::format("Fewest points of a used neighborhood, the query included; default {} for MME and MPV, {} "
                      "for MOM and OMME; mapeval and ais-bonn keep their own rule for MME",
                      options.settings.min_neighbors, options.settings.min_neighbors_orthogonal))
      ->group(group);
  verb.add_option("--definition", options.definition, "Whose definitions: paper, map-metrics, mapeval, ais-bonn")
      ->check(CLI::IsMember({"paper", "map-metrics", "mapeval", "ais-bonn"}))
      ->capture_default_str()
      ->group(group);
  verb.add_option("--query-every", options.settings.query_every, "Evaluate every n-th map point only")
      ->capture_default_str()
      ->group(group);
  verb.add_option(
          "--subset", options.subset,
          "Precomputed orthogonal subset: quoted pattern or comma list, one file (NPY, PLY, PCD) per direction, "
          "map frame")
      ->group(group);
}

}  // namespace trysquare::app
