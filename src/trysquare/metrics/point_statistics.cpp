// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/point_statistics.h"

#include "trysquare/parallel/for_each_block.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

namespace trysquare {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

/// λ₁ <= λ₂ <= λ₃ of a covariance, clamped at 0: rounding must not make a variance negative.
Eigen::Vector3d eigenvalues_of(const Eigen::Matrix3d& covariance) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance, Eigen::EigenvaluesOnly).eigenvalues().cwiseMax(0);
}

/// Exactly planar, or less than a plane: the determinant is rounding noise.
bool is_degenerate(const Eigen::Vector3d& eigenvalues) { return eigenvalues[0] <= 1e-12 * eigenvalues[2]; }

bool is_line_like(const Eigen::Vector3d& eigenvalues) { return eigenvalues[1] <= 0.01 * eigenvalues[2]; }

double log_determinant(const Eigen::Vector3d& eigenvalues) {
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

/// The moments without the query itself, which lies at distance 0 from the point that they are taken about.
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

/// MapEval (TBB version): the query does not count, and there must be ten others.
PointValue mapeval_entropy(const Moments& moments) {
  const Moments others = without_query(moments);
  if (others.count < 10) return {};
  const Eigen::Vector3d eigenvalues = eigenvalues_of(others.covariance);
  if (is_degenerate(eigenvalues)) return {kUndefined, &PointSupport::num_degenerate};
  return {mapeval_entropy_of(eigenvalues), &PointSupport::num_defined};
}

/// AIS-Bonn: divisor n, any count.
PointValue ais_bonn_entropy(const Moments& moments, const Eigen::Vector3d& eigenvalues) {
  if (moments.count == 0 || is_degenerate(eigenvalues)) return {kUndefined, &PointSupport::num_degenerate};
  const double n = moments.count;
  return {entropy_of(eigenvalues * ((n - 1) / n)), &PointSupport::num_defined};
}

PointValue entropy_by(Definition definition, const Moments& moments, const Eigen::Vector3d& eigenvalues,
                      std::uint32_t min_neighbors) {
  switch (definition) {
    case Definition::kMapEval:
      return mapeval_entropy(moments);
    case Definition::kAisBonn:
      return ais_bonn_entropy(moments, eigenvalues);
    case Definition::kPaper:
    case Definition::kMapMetrics:
      break;
  }
  return entropy(moments, eigenvalues, min_neighbors);
}

void add(PointSupport& total, const PointSupport& block) {
  total.num_defined += block.num_defined;
  total.num_degenerate += block.num_degenerate;
  total.num_too_few += block.num_too_few;
}

}  // namespace

PointStatistics point_statistics(const PointIndex& map, PointsView queries_in_map, const NeighborhoodSettings& settings,
                                 Definition definition, const Execution& execution) {
  PointStatistics result;
  result.plane_variances.resize(queries_in_map.size());
  result.entropies.resize(queries_in_map.size());
  result.num_neighbors.resize(queries_in_map.size());
  result.num_scans.resize(queries_in_map.size());
  const auto min_neighbors = static_cast<std::uint32_t>(std::max(settings.min_neighbors, 0));
  std::mutex totals_mutex;
  for_each_neighborhood(map, queries_in_map, settings, execution, [&](const NeighborhoodBlock& block) {
    PointSupport plane_variance_support;
    PointSupport entropy_support;
    std::size_t num_line_like = 0;
    for (std::size_t i = 0; i < block.moments.size(); ++i) {
      const std::size_t query = block.first_query + i;
      const Moments& moments = block.moments[i];
      const Eigen::Vector3d eigenvalues = eigenvalues_of(moments.covariance);
      const PointValue v = plane_variance(moments, eigenvalues, min_neighbors);
      const PointValue h = entropy_by(definition, moments, eigenvalues, min_neighbors);
      result.plane_variances[query] = v.value;
      result.entropies[query] = h.value;
      result.num_neighbors[query] = moments.count;
      result.num_scans[query] = moments.num_scans;
      ++(plane_variance_support.*v.counted_in);
      ++(entropy_support.*h.counted_in);
      if (moments.count >= min_neighbors && is_line_like(eigenvalues)) ++num_line_like;
    }
    const std::scoped_lock lock(totals_mutex);  // sums of integers: any order gives the same
    add(result.plane_variance_support, plane_variance_support);
    add(result.entropy_support, entropy_support);
    result.num_line_like += num_line_like;
  });
  return result;
}

}  // namespace trysquare
