// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/pose_errors.h"

#include "trysquare/adjustment/internal/normal_equations.h"
#include "trysquare/core/error.h"
#include "trysquare/parallel/for_each_block.h"
#include "trysquare/stats/median.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

namespace trysquare {
namespace {

using internal::Envelope;
using internal::Matrix6d;
using internal::NormalEquations;
using internal::Vector6d;
using internal::WeightedEquation;
using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower>;

constexpr double kRoughness_m = 0.005;  ///< What surfaces deviate from planes between scans, besides sensor noise.
constexpr int kHuberSteps = 3;
constexpr int kSteps = 8;
constexpr double kCutoff = 3;        ///< Of the residuals, in scales.
constexpr double kTukeyWidth = 1.6;  ///< Tukey's weight is 0 from kTukeyWidth · kCutoff scales on.
constexpr double kSmallestScale = 0.3;
constexpr std::size_t kNumSums = 4;  ///< Partial sums of the normal equations: fixed, whatever the threads.

/// The problem with everything that does not change from step to step.
struct Problem {
  std::vector<std::vector<WeightedEquation>> equations;  ///< By patch; weights without the robust factor.
  Envelope envelope;
};

Vector6d jacobian_of(const ObservedPatch& patch, const Eigen::Vector3d& position_in_map) {
  Vector6d jacobian;
  jacobian << patch.normal_in_map, (patch.center_in_map - position_in_map).cross(patch.normal_in_map);
  return jacobian;
}

Problem set_up(std::span<const ObservedPatch> patches, std::span<const Eigen::Vector3d> positions_in_map) {
  Problem problem{.equations = std::vector<std::vector<WeightedEquation>>(patches.size()),
                  .envelope = Envelope(positions_in_map.size())};
  std::iota(problem.envelope.begin(), problem.envelope.end(), 0U);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    for (const PatchObservation& observation : patches[p].observations) {
      std::uint32_t& first = problem.envelope[observation.scan];
      first = std::min(first, patches[p].observations.front().scan);
      problem.equations[p].push_back({.scan = observation.scan,
                                      .jacobian = jacobian_of(patches[p], positions_in_map[observation.scan]),
                                      .weight = 1 / (observation.variance_m2 + kRoughness_m * kRoughness_m),
                                      .value = observation.intercept_m});
    }
  }
  return problem;
}

NormalEquations assemble(const Problem& problem, const std::vector<std::vector<double>>& robust,
                         const Execution& execution) {
  const std::size_t block_size = std::max<std::size_t>(1, (problem.equations.size() + kNumSums - 1) / kNumSums);
  std::vector<NormalEquations> sums(std::max<std::size_t>(1, num_blocks(problem.equations.size(), block_size)),
                                    NormalEquations(problem.envelope));
  for_each_block(problem.equations.size(), block_size, {.num_threads = execution.num_threads}, "adjustment",
                 [&](const Block& block) {
                   std::vector<WeightedEquation> weighted;
                   for (std::size_t p = block.begin; p < block.end; ++p) {
                     weighted = problem.equations[p];
                     for (std::size_t i = 0; i < weighted.size(); ++i) weighted[i].weight *= robust[p][i];
                     sums[block.index].add_patch(weighted);
                   }
                 });
  for (std::size_t i = 1; i < sums.size(); ++i) sums[0].add(sums[i]);
  return std::move(sums[0]);
}

/// Residuals of all observations, in predicted standard deviations: (a − prediction − height) · sqrt(weight).
std::vector<std::vector<double>> standardized_residuals(const Problem& problem,
                                                        const std::vector<std::vector<double>>& robust,
                                                        const Eigen::VectorXd& errors) {
  std::vector<std::vector<double>> residuals(problem.equations.size());
  for (std::size_t p = 0; p < problem.equations.size(); ++p) {
    const std::vector<WeightedEquation>& equations = problem.equations[p];
    double sum_of_weights = 0;
    double height = 0;
    for (std::size_t i = 0; i < equations.size(); ++i) {
      const WeightedEquation& each = equations[i];
      const double weight = each.weight * robust[p][i];
      residuals[p].push_back(each.value - each.jacobian.dot(errors.segment<6>(6 * each.scan)));
      sum_of_weights += weight;
      height += weight * residuals[p].back();
    }
    if (sum_of_weights > 0) height /= sum_of_weights;
    for (std::size_t i = 0; i < equations.size(); ++i) {
      residuals[p][i] = (residuals[p][i] - height) * std::sqrt(equations[i].weight);
    }
  }
  return residuals;
}

double scale_of(const std::vector<std::vector<double>>& residuals) {
  std::vector<double> magnitudes;
  for (const std::vector<double>& of_patch : residuals) {
    for (const double residual : of_patch) magnitudes.push_back(std::abs(residual));
  }
  constexpr double kSigmaOfMedianAbsolute = 1.4826;  // of a normal distribution
  return std::max(kSigmaOfMedianAbsolute * median_of_defined(magnitudes).value_or(0), kSmallestScale);
}

double robust_weight(double residual, double scale, bool by_tukey) {
  const double ratio = std::abs(residual) / (kCutoff * scale);
  if (!by_tukey) return ratio < 1 ? 1 : 1 / ratio;
  const double inside = std::max(0.0, 1 - ratio * ratio / (kTukeyWidth * kTukeyWidth));
  return inside * inside;
}

/// Weights below 1 let residuals pass for smaller than they are: mean weight over the mean derivative of Tukey's score.
double robustness_factor(const std::vector<std::vector<double>>& weights) {
  double sum_of_weights = 0;
  double sum_of_derivatives = 0;
  for (const std::vector<double>& of_patch : weights) {
    for (const double weight : of_patch) {
      const double inside = std::sqrt(weight);  // 1 − u², u the residual over its cutoff
      sum_of_weights += weight;
      sum_of_derivatives += inside * (5 * inside - 4);  // d/du of u (1 − u²)²
    }
  }
  return sum_of_derivatives > 0 ? sum_of_weights / sum_of_derivatives : 1;
}

/// Sums of the scores (weight · residual · Jacobian) of the patches of one block of space.
std::vector<Eigen::VectorXd> scores_of_blocks(const Problem& problem, std::span<const ObservedPatch> patches,
                                              const std::vector<std::vector<double>>& robust,
                                              const std::vector<std::vector<double>>& residuals, double block_m) {
  const auto size = static_cast<Eigen::Index>(6 * problem.envelope.size());
  std::map<std::array<double, 3>, Eigen::VectorXd> of_block;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (problem.equations[p].empty()) continue;
    const Eigen::Vector3d cell = (patches[p].center_in_map / block_m).array().floor();
    Eigen::VectorXd& score =
        of_block.try_emplace({cell.x(), cell.y(), cell.z()}, Eigen::VectorXd::Zero(size)).first->second;
    for (std::size_t i = 0; i < problem.equations[p].size(); ++i) {
      const WeightedEquation& each = problem.equations[p][i];
      score.segment<6>(6 * each.scan) += std::sqrt(each.weight) * robust[p][i] * residuals[p][i] * each.jacobian;
    }
  }
  std::vector<Eigen::VectorXd> scores;
  for (auto& [cell, score] : of_block) scores.push_back(std::move(score));
  return scores;
}

/// Mean over pairs i < j of ‖x_i − x_j‖², from the sum of squares and the square of the sum of all N.
double mean_over_pairs(double sum_of_squares, const Eigen::Vector3d& sum, double n) {
  return (n * sum_of_squares - sum.squaredNorm()) / (n * (n - 1) / 2);
}

/// What one block of space contributes: how far its scores move the poses, as seen from pose 0.
void add_block(const std::vector<PoseError>& moved, std::span<const std::vector<PosePair>> pair_sets,
               PoseErrorCovariance& covariance) {
  const auto of_pose = [&](std::size_t i) {
    Vector6d x;
    x << moved[i].translation_m, moved[i].rotation_rad;
    return x;
  };
  Vector6d sum = Vector6d::Zero();
  Eigen::Vector2d sum_of_squares = Eigen::Vector2d::Zero();
  for (std::size_t i = 1; i < moved.size(); ++i) {
    const Vector6d x = of_pose(i);
    covariance.of_pose[i] += x * x.transpose();
    sum += x;
    sum_of_squares += Eigen::Vector2d(x.head<3>().squaredNorm(), x.tail<3>().squaredNorm());
  }
  const auto n = static_cast<double>(covariance.of_pose.size());
  covariance.all_pairs.translation_m2 += mean_over_pairs(sum_of_squares[0], sum.head<3>(), n);
  covariance.all_pairs.rotation_rad2 += mean_over_pairs(sum_of_squares[1], sum.tail<3>(), n);
  for (std::size_t k = 0; k < pair_sets.size(); ++k) {
    const auto num_pairs = static_cast<double>(pair_sets[k].size());
    for (const PosePair& pair : pair_sets[k]) {
      const Vector6d difference = of_pose(pair.second) - of_pose(pair.first);
      covariance.of_pairs[k].translation_m2 += difference.head<3>().squaredNorm() / num_pairs;
      covariance.of_pairs[k].rotation_rad2 += difference.tail<3>().squaredNorm() / num_pairs;
    }
  }
}

std::vector<PoseError> pose_errors_of(const Eigen::VectorXd& errors) {
  std::vector<PoseError> result;
  for (Eigen::Index i = 0; i < errors.size(); i += 6) {
    result.push_back({.translation_m = errors.segment<3>(i), .rotation_rad = errors.segment<3>(i + 3)});
  }
  return result;
}

Eigen::VectorXd errors_of(const std::vector<PoseError>& of_pose) {
  Eigen::VectorXd errors(static_cast<Eigen::Index>(6 * of_pose.size()));
  for (std::size_t i = 0; i < of_pose.size(); ++i) {
    errors.segment<6>(static_cast<Eigen::Index>(6 * i)) << of_pose[i].translation_m, of_pose[i].rotation_rad;
  }
  return errors;
}

}  // namespace

PoseErrors solve_pose_errors(std::span<const ObservedPatch> patches, std::span<const Eigen::Vector3d> positions_in_map,
                             const Execution& execution) {
  if (positions_in_map.size() < 2) throw InvalidArgument("pose errors need at least two poses");
  const Problem problem = set_up(patches, positions_in_map);
  std::vector<std::vector<double>> robust;
  std::size_t num_observations = 0;
  for (const std::vector<WeightedEquation>& of_patch : problem.equations) {
    robust.emplace_back(of_patch.size(), 1.0);
    num_observations += of_patch.size();
  }
  const std::size_t num_poses = positions_in_map.size();
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * num_poses));
  if (num_observations == 0) return {.of_pose = pose_errors_of(errors), .weights = std::move(robust)};

  Solver solver;
  double scale = 0;
  for (int step = 0; step < kSteps; ++step) {
    const NormalEquations normal = assemble(problem, robust, execution);
    const Eigen::SparseMatrix<double> matrix = normal.matrix();
    solver.compute(matrix);
    if (solver.info() != Eigen::Success) break;  // not finite input, at most: the prior keeps the matrix definite
    errors = solver.solve(normal.right_hand_side());
    const std::vector<std::vector<double>> residuals = standardized_residuals(problem, robust, errors);
    scale = scale_of(residuals);
    for (std::size_t p = 0; p < robust.size(); ++p) {
      for (std::size_t i = 0; i < robust[p].size(); ++i) {
        robust[p][i] = robust_weight(residuals[p][i], scale, step >= kHuberSteps);
      }
    }
  }
  return {.of_pose = pose_errors_of(errors), .weights = std::move(robust), .residual_scale = scale};
}

PoseErrorCovariance pose_error_covariance(std::span<const ObservedPatch> patches,
                                          std::span<const Eigen::Vector3d> positions_in_map, const PoseErrors& errors,
                                          double block_m, std::span<const std::vector<PosePair>> pair_sets,
                                          const Execution& execution) {
  const Problem problem = set_up(patches, positions_in_map);
  PoseErrorCovariance covariance{.of_pose = std::vector<Matrix6d>(positions_in_map.size(), Matrix6d::Zero()),
                                 .of_pairs = std::vector<PairVariance>(pair_sets.size())};
  const Solver solver(assemble(problem, errors.weights, execution).matrix());
  const std::vector<std::vector<double>> residuals =
      standardized_residuals(problem, errors.weights, errors_of(errors.of_pose));
  const std::vector<Eigen::VectorXd> scores = scores_of_blocks(problem, patches, errors.weights, residuals, block_m);
  covariance.num_blocks = scores.size();
  if (scores.size() < 2) return covariance;
  const double robustness = robustness_factor(errors.weights);
  const double correction =
      robustness * robustness * static_cast<double>(scores.size()) / (static_cast<double>(scores.size()) - 1);
  for (const Eigen::VectorXd& score : scores) {
    const Eigen::VectorXd moved = std::sqrt(correction) * solver.solve(score);
    add_block(relative_to_first(pose_errors_of(moved), positions_in_map), pair_sets, covariance);
  }
  return covariance;
}

std::vector<PoseError> relative_to_first(std::span<const PoseError> errors,
                                         std::span<const Eigen::Vector3d> positions_in_map) {
  std::vector<PoseError> result;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const Eigen::Vector3d lever = positions_in_map[i] - positions_in_map[0];
    const Eigen::Vector3d shared_m = errors[0].translation_m + errors[0].rotation_rad.cross(lever);
    result.push_back({.translation_m = errors[i].translation_m - shared_m,
                      .rotation_rad = errors[i].rotation_rad - errors[0].rotation_rad});
  }
  return result;
}

Pose without_error(const Pose& map_from_scan, const PoseError& error) {
  const double angle = error.rotation_rad.norm();
  const Eigen::Vector3d axis = angle > 0 ? Eigen::Vector3d(error.rotation_rad / angle) : Eigen::Vector3d::UnitX();
  return {.rotation = Eigen::AngleAxisd(-angle, axis).toRotationMatrix() * map_from_scan.rotation,
          .translation = map_from_scan.translation - error.translation_m};
}

PoseError error_between(const Pose& given, const Pose& corrected) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(given.rotation * corrected.rotation.transpose()));
  return {.translation_m = given.translation - corrected.translation, .rotation_rad = turn.angle() * turn.axis()};
}

}  // namespace trysquare
