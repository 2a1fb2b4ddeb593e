// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/internal/normal_equations.h"

namespace trysquare::internal {

NormalEquations::NormalEquations(const Envelope& envelope) : envelope_(envelope) {
  std::size_t num_blocks = 0;
  for (std::size_t row = 0; row < envelope.size(); ++row) {
    first_block_.push_back(num_blocks);
    num_blocks += row + 1 - envelope[row];
  }
  blocks_.assign(num_blocks, Matrix6d::Zero());
  right_hand_side_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * envelope.size()));
}

void NormalEquations::add_patch(std::span<const WeightedEquation> equations) {
  double sum_of_weights = 0;
  double weighted_mean = 0;
  for (const WeightedEquation& each : equations) {
    sum_of_weights += each.weight;
    weighted_mean += each.weight * each.value;
  }
  if (!(sum_of_weights > 0)) return;
  weighted_mean /= sum_of_weights;
  for (std::size_t i = 0; i < equations.size(); ++i) {
    const WeightedEquation& row = equations[i];
    if (row.weight == 0) continue;
    right_hand_side_.segment<6>(6 * row.scan) += row.weight * (row.value - weighted_mean) * row.jacobian;
    for (std::size_t j = 0; j < i; ++j) {
      const double factor = -row.weight * equations[j].weight / sum_of_weights;
      if (factor != 0)
        block(row.scan, equations[j].scan) += (factor * row.jacobian) * equations[j].jacobian.transpose();
    }
    const double own = row.weight - row.weight * row.weight / sum_of_weights;
    block(row.scan, row.scan) += (own * row.jacobian) * row.jacobian.transpose();
  }
}

void NormalEquations::add(const NormalEquations& other) {
  for (std::size_t i = 0; i < blocks_.size(); ++i) blocks_[i] += other.blocks_[i];
  right_hand_side_ += other.right_hand_side_;
}

Eigen::SparseMatrix<double> NormalEquations::matrix() const {
  const auto num_poses = static_cast<std::uint32_t>(envelope_.size());
  double trace = 0;
  for (std::uint32_t pose = 0; pose < num_poses; ++pose) trace += block(pose, pose).trace();
  constexpr double kPrior = 1e-9;
  const double prior = kPrior * trace / (6.0 * num_poses) + 1e-12;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(blocks_.size() * 36);
  for (std::uint32_t row = 0; row < num_poses; ++row) {
    for (std::uint32_t column = envelope_[row]; column <= row; ++column) {
      const Matrix6d& values = block(row, column);
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < (row == column ? i + 1 : 6); ++j) {
          const double diagonal = row == column && i == j ? prior : 0;
          if (values(i, j) + diagonal == 0) continue;
          entries.emplace_back(6 * row + static_cast<unsigned>(i), 6 * column + static_cast<unsigned>(j),
                               values(i, j) + diagonal);
        }
      }
    }
  }
  const auto size = static_cast<Eigen::Index>(6 * num_poses);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace trysquare::internal
