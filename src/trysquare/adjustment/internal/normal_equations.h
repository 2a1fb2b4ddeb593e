// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trysquare::internal {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// One equation of a patch: its scan, Jacobian, weight and right hand side.
struct WeightedEquation {
  std::uint32_t scan = 0;
  Vector6d jacobian = Vector6d::Zero();
  double weight = 0;
  double value = 0;
};

/// First scan that shares a patch with scan i, for every i: where row i of the normal matrix begins.
using Envelope = std::vector<std::uint32_t>;

/// Normal equations of N poses with six unknowns each, blocks of 6 × 6 within an envelope, lower triangle.
class NormalEquations {
 public:
  explicit NormalEquations(const Envelope& envelope);

  /// Adds a patch's equations value = h + jacobian · x(scan), h eliminated. REQUIRES scans in ascending order.
  void add_patch(std::span<const WeightedEquation> equations);
  void add(const NormalEquations& other);

  const Eigen::VectorXd& right_hand_side() const { return right_hand_side_; }

  /// Lower triangle, with a tiny prior: a pose that nothing observes stays where it is, and so do all of them together,
  /// whose common motion no patch sees.
  Eigen::SparseMatrix<double> matrix() const;

 private:
  Matrix6d& block(std::uint32_t row, std::uint32_t column) {
    return blocks_[first_block_[row] + column - envelope_[row]];
  }
  const Matrix6d& block(std::uint32_t row, std::uint32_t column) const {
    return blocks_[first_block_[row] + column - envelope_[row]];
  }

  Envelope envelope_;
  std::vector<std::size_t> first_block_;
  std::vector<Matrix6d> blocks_;
  Eigen::VectorXd right_hand_side_;
};

}  // namespace trysquare::internal
