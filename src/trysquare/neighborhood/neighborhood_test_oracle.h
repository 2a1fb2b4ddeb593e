// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/neighborhood/internal/vector_kernels.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace trysquare::test {

inline std::vector<std::string> names_of_kernels() {
  std::vector<std::string> names;
  for (const VectorKernels& kernels : vector_kernels()) names.emplace_back(kernels.name);
  return names;
}

inline const VectorKernels& kernels_named(const std::string& name) {
  for (const VectorKernels& kernels : vector_kernels()) {
    if (kernels.name == name) return kernels;
  }
  throw std::out_of_range(name);
}

/// One neighborhood by brute force, in two passes in long double.
struct ExactNeighborhood {
  using Real = long double;
  using Vector = Eigen::Matrix<Real, 3, 1>;
  using Matrix = Eigen::Matrix<Real, 3, 3>;

  std::uint32_t count = 0;
  std::uint32_t num_scans = 0;
  Vector mean_from_query = Vector::Zero();
  Vector eigenvalues = Vector::Zero();
};

inline ExactNeighborhood::Vector exact_eigenvalues(const ExactNeighborhood::Matrix& covariance) {
  return Eigen::SelfAdjointEigenSolver<ExactNeighborhood::Matrix>(covariance, Eigen::EigenvaluesOnly).eigenvalues();
}

inline ExactNeighborhood exact_neighborhood(const std::vector<Eigen::Vector3d>& points,
                                            const std::vector<std::uint32_t>& scan_of_point,
                                            const Eigen::Vector3d& query, double radius_m) {
  using Vector = ExactNeighborhood::Vector;
  ExactNeighborhood result;
  std::vector<Vector> from_query;
  std::set<std::uint32_t> scans;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d d = points[i] - query;
    if (!((d.x() * d.x() + d.y() * d.y()) + d.z() * d.z() < radius_m * radius_m)) continue;
    from_query.push_back(points[i].cast<long double>() - query.cast<long double>());
    if (!scan_of_point.empty()) scans.insert(scan_of_point[i]);
  }
  result.count = static_cast<std::uint32_t>(from_query.size());
  result.num_scans = static_cast<std::uint32_t>(scans.size());
  for (const Vector& d : from_query) result.mean_from_query += d;
  if (result.count > 0) result.mean_from_query /= static_cast<long double>(result.count);
  if (result.count < 2) return result;
  ExactNeighborhood::Matrix covariance = ExactNeighborhood::Matrix::Zero();
  for (const Vector& d : from_query) {
    const Vector from_mean = d - result.mean_from_query;
    covariance += from_mean * from_mean.transpose();
  }
  result.eigenvalues = exact_eigenvalues(covariance / static_cast<long double>(result.count - 1));
  return result;
}

}  // namespace trysquare::test
