// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/point_statistics.h"

#include "trysquare/neighborhood/eigenvalues.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

std::vector<Eigen::Vector3d> eigenvalues_of(std::span<const Moments> moments) {
  std::vector<Eigen::Vector3d> result(moments.size());
  eigenvalues(moments, result);
  return result;
}

/// Exactly planar, or less than a plane: the determinant is rounding noise.
bool is_degenerate(const Eigen::Vector3d& eigenvalues) { return eigenvalues[0] <= 1e-12 * eigenvalues[2]; }

bool is_line_like(const Eigen::Vector3d& eigenvalues) { return eigenvalues[1] <= 0.01 * eigenvalues[2]; }

/// One logarithm instead of three, unless the product leaves the range of doubles.
double log_determinant(const Eigen::Vector3d& eigenvalues) {
  const double determinant = eigenvalues.prod();
  if (std::isnormal(determinant)) return std::log(determinant);
  return std::log(eigenvalues[0]) + std::log(eigenvalues[1]) + std::log(eigenvalues[2]);
}

/// ½ ln det(2πe Σ): the paper's formula with the logarithm that its text lost.
double entropy_of(const Eigen::Vector3d& eigenvalues) {
  static constexpr double kTwoPiE = 2 * std::numbers::pi * std::numbers::e;
  return 0.5 * (3 * std::log(kTwoPiE) + log_determinant(eigenvalues));
}

/// MapEval leaves the cube off 2πe: lower by ln(2πe).
double mapeval_entropy_of(const Eigen::Vector3d& eigenvalues) {
  return 0.5 * (std::log(2 * std::numbers::pi * std::numbers::e) + log_determinant(eigenvalues));
}

/// The moments without the query itself, which lies at distance 0 from the point that they are taken about: MapEval
/// counts the others.
Moments without_query(const Moments& all) {
  if (all.count < 2) return {};
  const double n = all.count;
  const Eigen::Vector3d sum = n * all.mean_from_query;
  const Eigen::Matrix3d sum_of_squares = (n - 1) * all.covariance + sum * sum.transpose() / n;
  Moments others{.count = all.count - 1, .num_scans = all.num_scans, .mean_from_query = sum / (n - 1)};
  if (others.count >= 2) others.covariance = (sum_of_squares - sum * sum.transpose() / (n - 1)) / (n - 2);
  return others;
}

/// One value of one point, and what became of it.
struct PointValue {
  double value = kUndefined;
  std::size_t PointSupport::*counted_in = &PointSupport::num_too_few;
};

PointValue plane_variance(const Moments& moments, const Eigen::Vector3d& eigenvalues, std::uint32_t min_neighbors) {
  if (moments.count < min_neighbors) return {};
  if (is_degenerate(eigenvalues)) return {0.0, &PointSupport::num_degenerate};
  return {eigenvalues[0], &PointSupport::num_defined};
}

PointValue entropy(const Moments& moments, const Eigen::Vector3d& eigenvalues, std::uint32_t min_neighbors) {
  if (moments.count < min_neighbors) return {};
  if (is_degenerate(eigenvalues)) return {kUndefined, &PointSupport::num_degenerate};
  return {entropy_of(eigenvalues), &PointSupport::num_defined};
}

/// MapEval (TBB version): there must be ten others.
PointValue mapeval_entropy(const Moments& others, const Eigen::Vector3d& eigenvalues) {
  if (others.count < 10) return {};
  if (is_degenerate(eigenvalues)) return {kUndefined, &PointSupport::num_degenerate};
  return {mapeval_entropy_of(eigenvalues), &PointSupport::num_defined};
}

/// AIS-Bonn: divisor n, any count.
PointValue ais_bonn_entropy(const Moments& moments, const Eigen::Vector3d& eigenvalues) {
  if (moments.count == 0 || is_degenerate(eigenvalues)) return {kUndefined, &PointSupport::num_degenerate};
  const double n = moments.count;
  return {entropy_of(eigenvalues * ((n - 1) / n)), &PointSupport::num_defined};
}

/// The entropies of the queries of a block.
std::vector<PointValue> entropies(Definition definition, std::span<const Moments> moments,
                                  std::span<const Eigen::Vector3d> eigenvalues, std::uint32_t min_neighbors) {
  std::vector<PointValue> result(moments.size());
  if (definition == Definition::kMapEval) {
    std::vector<Moments> others(moments.size());
    std::transform(moments.begin(), moments.end(), others.begin(), without_query);
    const std::vector<Eigen::Vector3d> eigenvalues_of_others = eigenvalues_of(others);
    std::transform(others.begin(), others.end(), eigenvalues_of_others.begin(), result.begin(), mapeval_entropy);
    return result;
  }
  std::transform(moments.begin(), moments.end(), eigenvalues.begin(), result.begin(),
                 [&](const Moments& m, const Eigen::Vector3d& lambda) {
                   return definition == Definition::kAisBonn ? ais_bonn_entropy(m, lambda)
                                                             : entropy(m, lambda, min_neighbors);
                 });
  return result;
}

void add_support(PointSupport& total, const PointSupport& block) {
  total.num_defined += block.num_defined;
  total.num_degenerate += block.num_degenerate;
  total.num_too_few += block.num_too_few;
}

/// Room for the values of queries that arrive block by block, from several threads.
class Collector {
 public:
  Collector(std::size_t num_queries, const NeighborhoodSettings& settings, Definition definition)
      : min_neighbors_(static_cast<std::uint32_t>(std::max(settings.min_neighbors, 0))), definition_(definition) {
    result_.plane_variances.resize(num_queries);
    result_.entropies.resize(num_queries);
    result_.num_neighbors.resize(num_queries);
    result_.num_scans.resize(num_queries);
  }

  void add(const NeighborhoodBlock& block) {
    PointStatistics totals;
    const std::vector<Eigen::Vector3d> lambdas = eigenvalues_of(block.moments);
    const std::vector<PointValue> block_entropies = entropies(definition_, block.moments, lambdas, min_neighbors_);
    for (std::size_t i = 0; i < block.moments.size(); ++i) {
      const std::size_t query = block.queries[i];
      const Moments& moments = block.moments[i];
      const PointValue v = plane_variance(moments, lambdas[i], min_neighbors_);
      const PointValue& h = block_entropies[i];
      result_.plane_variances[query] = v.value;
      result_.entropies[query] = h.value;
      result_.num_neighbors[query] = moments.count;
      result_.num_scans[query] = moments.num_scans;
      ++(totals.plane_variance_support.*v.counted_in);
      ++(totals.entropy_support.*h.counted_in);
      if (moments.count >= min_neighbors_ && is_line_like(lambdas[i])) ++totals.num_line_like;
    }
    const std::scoped_lock lock(totals_mutex_);  // sums of integers: any order gives the same
    add_support(result_.plane_variance_support, totals.plane_variance_support);
    add_support(result_.entropy_support, totals.entropy_support);
    result_.num_line_like += totals.num_line_like;
  }

  PointStatistics result() && { return std::move(result_); }

 private:
  std::uint32_t min_neighbors_;
  Definition definition_;
  PointStatistics result_;
  std::mutex totals_mutex_;
};

}  // namespace

PointStatistics point_statistics(const PointIndex& map, PointsView queries_in_map, const NeighborhoodSettings& settings,
                                 Definition definition, const Execution& execution) {
  Collector collector(queries_in_map.size(), settings, definition);
  for_each_neighborhood(map, queries_in_map, settings, execution,
                        [&](const NeighborhoodBlock& block) { collector.add(block); });
  return std::move(collector).result();
}

PointStatistics point_statistics(std::span<const Moments> moments, const NeighborhoodSettings& settings,
                                 Definition definition) {
  settings.validate();
  std::vector<std::uint32_t> queries(moments.size());
  std::iota(queries.begin(), queries.end(), 0U);
  Collector collector(moments.size(), settings, definition);
  collector.add({.queries = queries, .moments = moments});
  return std::move(collector).result();
}

}  // namespace trysquare
