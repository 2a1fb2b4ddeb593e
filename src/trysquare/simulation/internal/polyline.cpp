// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/internal/polyline.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace trysquare::internal {

Polyline::Polyline(std::vector<Eigen::Vector3d> points, bool is_loop) : points_(std::move(points)), is_loop_(is_loop) {
  if (is_loop) points_.push_back(points_.front());
  at_m_.push_back(0);
  for (std::size_t i = 1; i < points_.size(); ++i) at_m_.push_back(at_m_.back() + (points_[i] - points_[i - 1]).norm());
}

Eigen::Vector3d Polyline::at(double s_m) const {
  const double length = length_m();
  const double s = is_loop_ ? s_m - length * std::floor(s_m / length) : std::clamp(s_m, 0.0, length);
  const auto next = std::upper_bound(at_m_.begin(), at_m_.end(), s);
  const auto i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(next - at_m_.begin() - 1, 0, static_cast<std::ptrdiff_t>(points_.size()) - 2));
  const double piece = at_m_[i + 1] - at_m_[i];
  const double share = piece > 0 ? std::min((s - at_m_[i]) / piece, 1.0) : 0;
  return points_[i] + share * (points_[i + 1] - points_[i]);
}

Eigen::Vector3d Polyline::ahead(double s_m, double reach_m) const {
  return (at(s_m + reach_m) - at(s_m - reach_m)).normalized();
}

void append_rounded_corner(const Eigen::Vector2d& before, const Eigen::Vector2d& corner, const Eigen::Vector2d& after,
                           double radius_m, std::vector<Eigen::Vector2d>& route) {
  constexpr int kSteps = 12;
  const Eigen::Vector2d begin = corner + radius_m * (before - corner).normalized();
  const Eigen::Vector2d end = corner + radius_m * (after - corner).normalized();
  for (int i = 0; i <= kSteps; ++i) {  // a quadratic Bézier curve
    const double t = static_cast<double>(i) / kSteps;
    route.emplace_back((1 - t) * (1 - t) * begin + 2 * t * (1 - t) * corner + t * t * end);
  }
}

Eigen::Matrix3d rotation_looking(const Eigen::Vector3d& forward) {
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(forward).normalized();
  Eigen::Matrix3d rotation;
  rotation << forward, left, forward.cross(left);
  return rotation;
}

}  // namespace trysquare::internal
