// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "peers.h"
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace trysquare::bench {

/// The sample covariance (divisor n - 1) of some neighbors, in two passes: the way that loses no digits.
template <typename Neighbors, typename PointOf>
Eigen::Matrix3d covariance_of(const Neighbors& neighbors, const PointOf& point_of) {
  const auto n = static_cast<double>(neighbors.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& neighbor : neighbors) mean += point_of(neighbor);
  mean /= n;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& neighbor : neighbors) {
    const Eigen::Vector3d d = point_of(neighbor) - mean;
    sum.noalias() += d * d.transpose();
  }
  return sum / (n - 1);
}

/// MPV and MME of the peers, by the definitions of trysquare, written a second time.
class NeighborhoodValues {
 public:
  static constexpr std::size_t kMinNeighbors = 6;

  void add(const Eigen::Matrix3d& covariance) {
    const Eigen::Vector3d eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance, Eigen::EigenvaluesOnly).eigenvalues();
    ++num_plane_variances_;
    if (!(eigenvalues[0] > 1e-12 * eigenvalues[2])) return;  // exactly planar: variance 0, no entropy
    sum_of_plane_variances_ += eigenvalues[0];
    sum_of_entropies_ += 0.5 * std::log(std::pow(2 * std::numbers::pi * std::numbers::e, 3) * eigenvalues.prod());
    ++num_entropies_;
  }

  void put_into(Outcome& outcome) const {
    if (num_plane_variances_ > 0) outcome.mpv = sum_of_plane_variances_ / static_cast<double>(num_plane_variances_);
    if (num_entropies_ > 0) outcome.mme = sum_of_entropies_ / static_cast<double>(num_entropies_);
  }

 private:
  double sum_of_plane_variances_ = 0;
  double sum_of_entropies_ = 0;
  std::uint64_t num_plane_variances_ = 0;
  std::uint64_t num_entropies_ = 0;
};

}  // namespace trysquare::bench
