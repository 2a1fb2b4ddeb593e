// SPDX-License-Identifier: Apache-2.0
#include "trysquare/experiments/metric_study.h"

#include "trysquare/core/error.h"
#include "trysquare/metrics/mme.h"
#include "trysquare/metrics/mom.h"
#include "trysquare/metrics/mpv.h"
#include "trysquare/metrics/omme.h"
#include "trysquare/neighborhood/stream_neighborhoods.h"
#include "trysquare/parallel/for_each_block.h"
#include "trysquare/synthetic/random.h"
#include "trysquare/trajectory/paper_rpe.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace trysquare {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

NeighborhoodSettings neighborhood_of(const MetricStudySettings& settings) {
  return {.radius_m = settings.radius_m, .min_neighbors = settings.min_neighbors};
}

NeighborhoodSettings orthogonal_neighborhood_of(const MetricStudySettings& settings) {
  return {.radius_m = settings.radius_m, .min_neighbors = settings.min_neighbors_orthogonal};
}

/// The scene as a trajectory has it, in the frame of the first scan.
class PerturbedMap {
 public:
  PerturbedMap(const StudyScene& scene, const Trajectory& estimate) : scene_(scene) {
    const Pose map_from_world = general_inverse(estimate.world_from_scan[0]);
    for (const Pose& pose : estimate.world_from_scan) map_from_scan_.push_back(map_from_world * pose);
  }

  std::vector<Eigen::Vector3d> points_of_scan(std::size_t scan) const {
    std::vector<Eigen::Vector3d> points_in_map;
    points_in_map.reserve(scene_.points_in_scan[scan].size());
    for (const Eigen::Vector3d& point : scene_.points_in_scan[scan]) {
      points_in_map.push_back(map_from_scan_[scan] * point);
    }
    return points_in_map;
  }

  void append(std::span<const ScanPoint> points, std::vector<Eigen::Vector3d>& points_in_map) const {
    for (const ScanPoint& point : points) {
      points_in_map.push_back(map_from_scan_[point.scan] * scene_.points_in_scan[point.scan][point.index]);
    }
  }

 private:
  const StudyScene& scene_;
  std::vector<Pose> map_from_scan_;
};

/// Of all queries of the scene in one run over the scans: MME's and MPV's first, then subset by subset, direction by
/// direction.
std::vector<Moments> moments_of(const StudyScene& scene, const Trajectory& estimate,
                                const NeighborhoodSettings& settings) {
  const PerturbedMap map(scene, estimate);
  std::vector<Eigen::Vector3d> queries;
  map.append(scene.queries, queries);
  for (const StudySubset& subset : scene.subsets) {
    for (const StudySubset::Direction& direction : subset.directions) map.append(direction.points, queries);
  }
  std::vector<Moments> moments(queries.size());
  stream_neighborhoods(
      scene.points_in_scan.size(), [&](std::size_t scan) { return map.points_of_scan(scan); }, queries, settings,
      {.num_threads = 1},
      [&](const NeighborhoodBlock& block) {
        for (std::size_t i = 0; i < block.queries.size(); ++i) moments[block.queries[i]] = block.moments[i];
      });
  return moments;
}

/// Trajectories of neighboring seeds share no stream.
std::uint64_t seed_of_trajectory(std::uint64_t seed, std::size_t index) { return Random(seed, index).bits(); }

}  // namespace

void MetricStudySettings::validate() const {
  if (num_trajectories < 1) throw InvalidArgument("num_trajectories = 0 is out of range: it must be >= 1");
  noise.validate();
  neighborhood_of(*this).validate();
  orthogonal_neighborhood_of(*this).validate();
}

std::vector<std::string> sample_columns(std::span<const StudySubset> subsets) {
  std::vector<std::string> columns = {"paper_rpe", "rpe", "mme", "mpv"};
  for (const StudySubset& subset : subsets) {
    for (const char* metric : {"omme", "mom", "mom_sum_of_medians"}) {
      columns.emplace_back(metric);
      columns.back() += subset.suffix;
    }
  }
  return columns;
}

std::vector<std::string> metric_columns(std::span<const std::string> columns) {
  std::vector<std::string> metrics;
  for (const std::string& column : columns) {
    if (column != "paper_rpe" && column != "rpe") metrics.push_back(column);
  }
  return metrics;
}

std::vector<double> metric_sample(const StudyScene& scene, const Trajectory& estimate,
                                  const MetricStudySettings& settings) {
  settings.validate();
  scene.validate();
  const std::vector<Moments> all = moments_of(scene, estimate, neighborhood_of(settings));
  const NeighborhoodSettings orthogonal = orthogonal_neighborhood_of(settings);
  std::span<const Moments> rest = all;
  const auto take = [&](std::size_t count) {
    const std::span<const Moments> taken = rest.first(count);
    rest = rest.subspan(count);
    return taken;
  };
  const PointStatistics points = point_statistics(take(scene.queries.size()), neighborhood_of(settings));
  const double rpe_m2 = paper_rpe(scene.true_poses, estimate);
  const auto num_others = static_cast<double>(estimate.size() - 1);
  std::vector<double> row = {rpe_m2, std::sqrt(rpe_m2 / num_others), mme(points).value.value_or(kUndefined),
                             mpv(points).value.value_or(kUndefined)};
  for (const StudySubset& subset : scene.subsets) {
    OrthogonalStatistics statistics;
    for (const StudySubset::Direction& direction : subset.directions) {
      statistics.directions.push_back(
          {direction.normal_in_map, point_statistics(take(direction.points.size()), orthogonal)});
    }
    const OrthogonalMetricResult variance = mom(statistics);
    row.push_back(omme(statistics).value.value_or(kUndefined));
    row.push_back(variance.mean_of_means.value_or(kUndefined));
    row.push_back(variance.sum_of_medians.value_or(kUndefined));
  }
  return row;
}

MetricSamples metric_samples(const StudyScene& scene, const MetricStudySettings& settings, const Execution& execution) {
  settings.validate();
  scene.validate();
  MetricSamples samples{.columns = sample_columns(scene.subsets), .rows = {}};
  samples.rows.resize(settings.num_trajectories);
  for_each_block(settings.num_trajectories, 1, execution, "trajectories", [&](const Block& block) {
    PerturbationSettings noise = settings.noise;
    noise.seed = seed_of_trajectory(settings.noise.seed, block.index);
    samples.rows[block.index] = metric_sample(scene, perturb(scene.true_poses, noise), settings);
  });
  return samples;
}

}  // namespace trysquare
