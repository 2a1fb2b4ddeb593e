// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/internal/agreement.h"

#include "trysquare/stats/median.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <unordered_map>

namespace trysquare::internal {
namespace {

constexpr double kInlierWeight = 0.3;

/// Groups of poses that are joined one after the other.
class Components {
 public:
  explicit Components(std::size_t num_poses) : parent_(num_poses), num_components_(num_poses) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  void join(std::size_t a, std::size_t b) {
    a = root_of(a);
    b = root_of(b);
    if (a == b) return;
    parent_[std::max(a, b)] = std::min(a, b);
    --num_components_;
  }

  std::size_t num_components() const { return num_components_; }

 private:
  std::size_t root_of(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }

  std::vector<std::size_t> parent_;
  std::size_t num_components_;
};

/// The scans that see a patch and were not taken for outliers.
std::vector<std::uint32_t> inlier_scans(const AdjustedPoses& adjusted, std::size_t patch) {
  std::vector<std::uint32_t> scans;
  const std::vector<PatchObservation>& seen = adjusted.observed[patch].observations;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (adjusted.errors.weights[patch][i] > kInlierWeight) scans.push_back(seen[i].scan);
  }
  return scans;
}

/// How much fewer patches a pose agrees with than the poses around it do: one that is far off finds some by chance.
void compare_with_neighbors(Agreement& result) {
  constexpr std::size_t kReach = 10;
  const std::vector<std::size_t>& counts = result.observations_of_pose;
  result.least_share_of_neighbors = 1;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::size_t end = std::min(counts.size(), i + kReach + 1);
    const std::vector<double> around(counts.begin() + static_cast<std::ptrdiff_t>(i - std::min(i, kReach)),
                                     counts.begin() + static_cast<std::ptrdiff_t>(end));
    const double usual = median_of_defined(around).value_or(0);
    const double share = usual > 0 ? static_cast<double>(counts[i]) / usual : 0;
    if (share >= result.least_share_of_neighbors) continue;
    result.least_share_of_neighbors = share;
    result.least_agreeing_pose = i;
  }
}

/// Poses [first, end) and the planes that they share. Groups may slide along a surface although they share it, each
/// held by planes that only itself agrees with.
class RunOfPoses {
 public:
  RunOfPoses(std::size_t first, std::size_t end)
      : first_(first),
        end_(end),
        poses_per_node_((end - first + kMostNodes - 1) / kMostNodes),
        ties_(Eigen::MatrixXd::Zero(size(), size())) {}

  std::size_t first() const { return first_; }
  std::size_t end() const { return end_; }

  void add(const std::vector<std::uint32_t>& scans, const Eigen::Vector3d& normal) {
    std::vector<Eigen::Index> rows;
    for (const std::uint32_t scan : scans) {
      if (scan < first_ || scan >= end_) continue;
      const auto row = 3 * static_cast<Eigen::Index>((scan - first_) / poses_per_node_);
      if (rows.empty() || rows.back() != row) rows.push_back(row);
    }
    num_inliers_ += rows.size();
    const Eigen::Matrix3d along = normal * normal.transpose();
    normals_ += static_cast<double>(rows.size()) * along;
    for (const Eigen::Index i : rows) {
      ties_.block<3, 3>(i, i) += along;
      for (const Eigen::Index j : rows) ties_.block<3, 3>(i, j) -= along / static_cast<double>(rows.size());
    }
  }

  /// Empty without any inlier.
  std::optional<PoseTie> tie() const {
    if (num_inliers_ == 0) return std::nullopt;
    // The common motions, which nothing ties, become the stiffest ones: what is left is a motion of some against
    // others.
    const Eigen::Index num_nodes = size() / 3;
    const double inliers_of_a_node = static_cast<double>(num_inliers_) / static_cast<double>(num_nodes);
    const double stiffest = 2 * inliers_of_a_node;
    const Eigen::MatrixXd common = Eigen::Matrix3d::Identity().replicate(num_nodes, num_nodes);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(ties_ + stiffest * common);
    const Eigen::VectorXd weakest = solver.eigenvectors().col(0);
    const Eigen::Map<const Eigen::Matrix3Xd> motion_of_node(weakest.data(), 3, num_nodes);
    Eigen::Index farthest = 0;
    motion_of_node.colwise().squaredNorm().maxCoeff(&farthest);
    const double eigenvalue = std::max(0.0, solver.eigenvalues()[0]);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of_normals(normals_ / static_cast<double>(num_inliers_),
                                                                    Eigen::EigenvaluesOnly);
    return PoseTie{.eigenvalue = eigenvalue / inliers_of_a_node,
                   .limit = kLeastTie * std::max(0.0, of_normals.eigenvalues()[0]),
                   .first_pose = first_,
                   .last_pose = end_ - 1,
                   .direction_in_map = motion_of_node.col(farthest).normalized()};
  }

 private:
  static constexpr std::size_t kMostNodes = 60;  ///< In longer runs some poses in a row count as one.

  Eigen::Index size() const {
    return 3 * static_cast<Eigen::Index>((end_ - first_ + poses_per_node_ - 1) / poses_per_node_);
  }

  std::size_t first_;
  std::size_t end_;
  std::size_t poses_per_node_;
  Eigen::MatrixXd ties_;
  Eigen::Matrix3d normals_ = Eigen::Matrix3d::Zero();
  std::size_t num_inliers_ = 0;
};

/// Six poses; where scans are so dense that only one in k looks at a patch (max_observers), 6 k.
std::size_t length_of_runs(const std::vector<ObservedPatch>& patches) {
  constexpr double kFewestPoses = 6;
  std::vector<double> steps;
  for (const ObservedPatch& patch : patches) {
    for (std::size_t i = 1; i < patch.observations.size(); ++i) {
      steps.push_back(static_cast<double>(patch.observations[i].scan - patch.observations[i - 1].scan));
    }
  }
  return static_cast<std::size_t>(kFewestPoses * median_of_defined(steps).value_or(1));
}

/// Each begins in the middle of the one before it: any two poses in a row lie in one run.
std::vector<RunOfPoses> runs_of_poses(std::size_t num_poses, std::size_t length) {
  length = std::min(length, num_poses);
  std::vector<RunOfPoses> runs{{0, length}};
  for (std::size_t end = length; end < num_poses;) {
    end = std::min(end + length / 2, num_poses);
    runs.emplace_back(end - length, end);
  }
  return runs;
}

}  // namespace

Agreement agreement_of(const AdjustedPoses& adjusted, std::size_t num_poses) {
  Agreement result{.observations_of_pose = std::vector<std::size_t>(num_poses)};
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  std::unordered_map<std::uint64_t, std::size_t> shared;
  std::vector<double> sigmas_m;
  std::vector<RunOfPoses> runs = runs_of_poses(num_poses, length_of_runs(adjusted.observed));
  for (std::size_t p = 0; p < adjusted.observed.size(); ++p) {
    const ObservedPatch& patch = adjusted.observed[p];
    if (!patch.observations.empty()) sigmas_m.push_back(patch.within_scan_sigma_m);
    const std::vector<std::uint32_t> scans = inlier_scans(adjusted, p);
    for (std::size_t j = 0; j < scans.size(); ++j) {
      ++result.observations_of_pose[scans[j]];
      for (std::size_t i = 0; i < j; ++i) ++shared[std::uint64_t{scans[i]} * num_poses + scans[j]];
    }
    if (scans.empty()) continue;
    auto run = std::partition_point(runs.begin(), runs.end(),
                                    [&](const RunOfPoses& each) { return each.end() <= scans.front(); });
    for (; run != runs.end() && run->first() <= scans.back(); ++run) run->add(scans, patch.normal_in_map);
    result.num_inliers += scans.size();
    normals += static_cast<double>(scans.size()) * patch.normal_in_map * patch.normal_in_map.transpose();
  }
  Components components(num_poses);
  for (const auto& [pair, count] : shared) {
    if (count >= kFewestSharedPatches) components.join(pair / num_poses, pair % num_poses);
  }
  result.num_components = components.num_components();
  const auto least = std::min_element(result.observations_of_pose.begin(), result.observations_of_pose.end());
  result.observations_per_pose_min = *least;
  result.least_observed_pose = static_cast<std::size_t>(least - result.observations_of_pose.begin());
  compare_with_neighbors(result);
  result.within_scan_sigma_m = median_of_defined(sigmas_m).value_or(0);
  if (result.num_inliers == 0) return result;
  for (const RunOfPoses& run : runs) {
    const std::optional<PoseTie> tie = run.tie();
    const auto margin = [](const PoseTie& each) { return each.eigenvalue - each.limit; };
    if (tie && (!result.weakest_tie || margin(*tie) < margin(*result.weakest_tie))) result.weakest_tie = tie;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normals / static_cast<double>(result.num_inliers));
  result.smallest_eigenvalue = std::max(0.0, solver.eigenvalues()[0]);
  result.weakest_direction_in_map = solver.eigenvectors().col(0);
  return result;
}

}  // namespace trysquare::internal
