// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/alignment.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/internal/validate.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace trysquare {
namespace {

constexpr std::array<std::pair<Alignment, std::string_view>, 5> kAlignments{{
    {Alignment::kNone, "none"},
    {Alignment::kOrigin, "origin"},
    {Alignment::kScale, "scale"},
    {Alignment::kSe3, "se3"},
    {Alignment::kSim3, "sim3"},
}};

/// Second singular value of the cross-covariance over the first, up to which positions count as being on one line:
/// a thickness of 1e-7 of the length. Round-off leaves 1e-15 there.
constexpr double kLineRatio = 1e-14;

Eigen::Matrix3Xd positions(const Trajectory& trajectory, Eigen::Index count) {
  Eigen::Matrix3Xd result(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    result.col(i) = trajectory.world_from_scan[static_cast<std::size_t>(i)].translation;
  }
  return result;
}

/// Similarity that minimises Σ ‖y_i − (c R x_i + t)‖²; the equation numbers are Umeyama's.
Similarity umeyama(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& y, bool with_scale) {
  const double n = static_cast<double>(x.cols());
  const Eigen::Vector3d mean_x = x.rowwise().mean();  // (34)
  const Eigen::Vector3d mean_y = y.rowwise().mean();  // (35)
  const Eigen::Matrix3Xd dx = x.colwise() - mean_x;
  const Eigen::Matrix3Xd dy = y.colwise() - mean_y;
  const Eigen::Matrix3d covariance = dy * dx.transpose() / n;  // (38)
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& d = svd.singularValues();
  if (x.cols() < 3 || !(d[1] > kLineRatio * d[0])) {
    throw InvalidArgument(
        fmt::format("the {} positions to align do not fix a rotation: at least three are needed, not all on one line, "
                    "in the reference and in the estimate",
                    x.cols()));
  }
  Eigen::Vector3d s = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) s[2] = -1;  // (43): a rotation, not a reflection
  Similarity y_from_x;
  y_from_x.pose.rotation = svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose();      // (40)
  if (with_scale) y_from_x.scale = d.dot(s) / (dx.squaredNorm() / n);                       // (42)
  y_from_x.pose.translation = mean_y - y_from_x.scale * (y_from_x.pose.rotation * mean_x);  // (41)
  return y_from_x;
}

}  // namespace

std::string_view name_of(Alignment alignment) { return kAlignments[static_cast<std::size_t>(alignment)].second; }

std::optional<Alignment> alignment_named(std::string_view name) {
  const auto* found =
      std::find_if(kAlignments.begin(), kAlignments.end(), [&](const auto& e) { return e.second == name; });
  if (found == kAlignments.end()) return std::nullopt;
  return found->first;
}

Similarity align(const Trajectory& reference, const Trajectory& estimate, Alignment alignment,
                 std::size_t num_poses_to_align) {
  internal::validate_poses(reference, estimate);
  if (alignment == Alignment::kNone) return {};
  if (alignment == Alignment::kOrigin) {
    return {.pose = reference.world_from_scan.front() * rigid_inverse(estimate.world_from_scan.front())};
  }
  const std::size_t wanted = num_poses_to_align == 0 ? reference.size() : num_poses_to_align;
  const auto count = static_cast<Eigen::Index>(std::min(wanted, reference.size()));
  Similarity result = umeyama(positions(estimate, count), positions(reference, count), alignment != Alignment::kSe3);
  if (alignment == Alignment::kScale) result.pose = {};
  return result;
}

Trajectory transformed(const Similarity& b_from_a, const Trajectory& trajectory_in_a) {
  Trajectory result = trajectory_in_a;
  for (Pose& pose : result.world_from_scan) {
    pose = b_from_a.pose * Pose{pose.rotation, b_from_a.scale * pose.translation};
  }
  return result;
}

}  // namespace trysquare
