// SPDX-License-Identifier: Apache-2.0
#include "trysquare/experiments/experiment.h"

#include "trysquare/core/error.h"
#include "trysquare/experiments/simulated_drive.h"
#include "trysquare/synthetic/plane_world.h"
#include "trysquare/synthetic/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace trysquare {
namespace {

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;
constexpr std::array kCounterexamples = {Counterexample::kBalanced, Counterexample::kUnbalanced,
                                         Counterexample::kNonOrthogonal};

/// A seed of its own for everything that has a name (FNV-1a).
std::uint64_t seed_of(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211u;
  return Random(seed, hash).bits();
}

std::vector<std::string> groups_of(ExperimentKind kind) {
  std::vector<std::string> groups;
  if (kind == ExperimentKind::kTown) {
    for (const std::string_view town : kSimulatedTowns) groups.emplace_back(town);
    return groups;
  }
  if (kind != ExperimentKind::kCounterexample) return {std::string(name_of(kind))};
  for (const Counterexample which : kCounterexamples) groups.emplace_back(name_of(which));
  return groups;
}

/// Of what does not change with poses and noise: "planes-e03".
std::uint64_t seed_of_environment(const ExperimentSettings& settings, const ExperimentUnit& unit) {
  return seed_of(settings.seed, fmt::format("{}-e{:02}", unit.group, unit.environment));
}

std::vector<Disc> discs_of(const ExperimentSettings& settings, const ExperimentUnit& unit) {
  for (const Counterexample which : kCounterexamples) {
    if (unit.group == name_of(which)) return counterexample_discs(which);
  }
  return random_plane_world(seed_of_environment(settings, unit));
}

/// The paper's way to find directions beside the product's.
std::vector<StudySubsetSettings> both_subsets() { return {{"", {}}, {"_paper", {.method = SubsetMethod::kPaper}}}; }

StudyScene scene_of(const ExperimentSettings& settings, const ExperimentUnit& unit, const ExperimentData& data,
                    const Execution& execution) {
  if (settings.kind == ExperimentKind::kScans) {
    if (data.scans == nullptr || data.true_poses == nullptr) {
      throw InvalidArgument("an experiment on scans needs scans and true poses");
    }
    const std::size_t longest = settings.num_poses.back();
    return scene_of_scans(*data.scans, *data.true_poses, unit.environment * longest, unit.num_poses, both_subsets(),
                          settings.radius_m, settings.scene, execution);
  }
  if (settings.kind == ExperimentKind::kStreet || settings.kind == ExperimentKind::kTown) {
    // The longest drive whatever the number of poses, so that all lengths see the same scans.
    const std::uint64_t seed = seed_of_environment(settings, unit);
    const auto scans = simulated_drive(unit.group, seed, settings.num_poses.back());
    return scene_of_scans(*scans, scans->true_poses(), 0, unit.num_poses, both_subsets(), settings.radius_m,
                          settings.scene, execution);
  }
  return scene_of_discs(discs_of(settings, unit), unit.num_poses,
                        {.point_sigma_m = settings.point_sigma_m, .seed = seed_of(settings.seed, unit.name())},
                        settings.scene);
}

void require_ascending(const std::vector<std::size_t>& num_poses) {
  const bool is_ascending =
      std::adjacent_find(num_poses.begin(), num_poses.end(), std::greater_equal<>()) == num_poses.end();
  if (!num_poses.empty() && num_poses.front() >= 2 && is_ascending) return;
  throw InvalidArgument(
      fmt::format("num_poses = {} is out of range: numbers >= 2 in ascending order", fmt::join(num_poses, ", ")));
}

}  // namespace

void ExperimentSettings::validate() const {
  if (num_environments < 1) throw InvalidArgument("num_environments = 0 is out of range: it must be >= 1");
  require_ascending(num_poses);
  if (num_trajectories < 2) {
    throw InvalidArgument(
        fmt::format("num_trajectories = {} is out of range: a correlation needs >= 2", num_trajectories));
  }
  if (rotation_sigmas_rad.empty()) throw InvalidArgument("rotation_sigmas_rad is empty: there must be one at least");
  for (const double sigma_rad : rotation_sigmas_rad) {
    PerturbationSettings{.translation_sigma_m = translation_sigma_m, .rotation_sigma_rad = sigma_rad}.validate();
  }
  MetricStudySettings{.num_trajectories = num_trajectories, .radius_m = radius_m}.validate();
  PlaneWorldSettings{.point_sigma_m = point_sigma_m}.validate();
  scene.validate();
  bootstrap.validate();
}

ExperimentSettings default_experiment(ExperimentKind kind) {
  ExperimentSettings settings{.kind = kind};
  switch (kind) {
    case ExperimentKind::kCounterexample:
      settings.num_environments = 10;
      break;
    case ExperimentKind::kPlanes:
      break;
    case ExperimentKind::kStreet:
    case ExperimentKind::kTown:
      settings.num_environments = 10;
      settings.rotation_sigmas_rad = {0.02 / kDegreesPerRadian, 0.2 / kDegreesPerRadian};
      settings.scene = {.num_queries = 500, .num_points_per_direction = 50};
      break;
    case ExperimentKind::kScans:
      settings.num_environments = 2;
      settings.num_poses = {5, 10};
      settings.rotation_sigmas_rad = {0.02 / kDegreesPerRadian, 0.2 / kDegreesPerRadian};
      settings.scene = {.num_queries = 1000, .num_points_per_direction = 100};
      break;
  }
  return settings;
}

std::string ExperimentUnit::name() const {
  const std::string rotation =
      rotation_sigma_rad == 0 ? "" : fmt::format("-r{:.6g}", rotation_sigma_rad * kDegreesPerRadian);
  return fmt::format("{}{}-e{:02}-n{:02}", group, rotation, environment, num_poses);
}

std::vector<ExperimentUnit> experiment_units(const ExperimentSettings& settings) {
  settings.validate();
  std::vector<ExperimentUnit> units;
  for (const std::string& group : groups_of(settings.kind)) {
    for (const double sigma_rad : settings.rotation_sigmas_rad) {
      for (const std::size_t num_poses : settings.num_poses) {
        for (std::size_t e = 0; e < settings.num_environments; ++e) units.push_back({group, e, num_poses, sigma_rad});
      }
    }
  }
  return units;
}

MetricSamples run_unit(const ExperimentSettings& settings, const ExperimentUnit& unit, const ExperimentData& data,
                       const Execution& execution) {
  settings.validate();
  const StudyScene scene = scene_of(settings, unit, data, execution);
  return metric_samples(scene,
                        {.num_trajectories = settings.num_trajectories,
                         .noise = {.translation_sigma_m = settings.translation_sigma_m,
                                   .rotation_sigma_rad = unit.rotation_sigma_rad,
                                   .seed = seed_of(settings.seed, unit.name() + "-noise"),
                                   .model = settings.noise_model},
                         .radius_m = settings.radius_m},
                        execution);
}

std::vector<MetricCorrelation> correlations_of(const ExperimentSettings& settings, const ExperimentUnit& unit,
                                               const MetricSamples& samples) {
  BootstrapSettings bootstrap = settings.bootstrap;
  bootstrap.seed = seed_of(settings.seed, unit.name() + "-bootstrap");
  return correlations_with_rpe(samples, settings.intervals, bootstrap);
}

std::vector<GroupSummary> summarize(const ExperimentSettings& settings, const std::vector<ExperimentUnit>& units,
                                    const std::vector<std::vector<MetricCorrelation>>& correlations) {
  if (units.size() != correlations.size()) {
    throw InvalidArgument(fmt::format("{} units but {} correlations", units.size(), correlations.size()));
  }
  std::vector<GroupSummary> summaries;
  for (std::size_t begin = 0; begin < units.size();) {
    const ExperimentUnit& first = units[begin];
    std::size_t end = begin;
    while (end < units.size() && units[end].group == first.group && units[end].num_poses == first.num_poses &&
           units[end].rotation_sigma_rad == first.rotation_sigma_rad) {
      ++end;
    }
    BootstrapSettings bootstrap = settings.bootstrap;
    bootstrap.seed = seed_of(settings.seed, first.name() + "-environments");
    summaries.push_back({first.group, first.num_poses, first.rotation_sigma_rad,
                         summary_over_environments(std::span(correlations).subspan(begin, end - begin), bootstrap)});
    begin = end;
  }
  return summaries;
}

}  // namespace trysquare
