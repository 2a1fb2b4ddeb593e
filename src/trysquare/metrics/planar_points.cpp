// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/planar_points.h"

#include <Eigen/Eigenvalues>

#include <cstddef>
#include <cstdint>

namespace trysquare {

PlanarPoints planar_points(const PointIndex& scan, PointsView queries, const NeighborhoodSettings& settings,
                           double planarity_ratio, const Execution& execution) {
  std::vector<Eigen::Vector3d> normals(queries.size(), Eigen::Vector3d::Zero());  // zero: not planar
  for_each_neighborhood(scan, queries, settings, execution, [&](const NeighborhoodBlock& block) {
    for (std::size_t i = 0; i < block.moments.size(); ++i) {
      if (block.moments[i].count < static_cast<std::uint32_t>(settings.min_neighbors)) continue;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(block.moments[i].covariance);
      const Eigen::Vector3d& lambda = solver.eigenvalues();
      const bool is_line = lambda[1] <= 1e-12 * lambda[2];  // both smaller ones are rounding
      if (!is_line && planarity_ratio * lambda[0] < lambda[1]) {
        normals[block.queries[i]] = solver.eigenvectors().col(0);
      }
    }
  });
  PlanarPoints result;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (normals[i].isZero(0)) continue;
    result.points.push_back(queries[i]);
    result.normals.push_back(normals[i]);
  }
  return result;
}

}  // namespace trysquare
