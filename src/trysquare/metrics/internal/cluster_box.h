// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <limits>

namespace trysquare::internal {

/// Axis-aligned box, empty by default.
///
/// The bounds below hold in floating point, without a margin: they subtract, square and add in the order of
/// `squared_distance`, and each of these steps is monotone after rounding.
struct ClusterBox {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());
};

inline ClusterBox box_of(const Eigen::Vector3d& point) { return {point, point}; }

inline ClusterBox mirrored(const ClusterBox& box) { return {-box.high, -box.low}; }

inline ClusterBox united(const ClusterBox& a, const ClusterBox& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

inline double squared_norm(double x, double y, double z) { return (x * x + y * y) + z * z; }

inline double squared_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
  return squared_norm(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

inline double squared_diagonal(const ClusterBox& box) { return squared_distance(box.high, box.low); }

/// No point of `a` is nearer to a point of `b`. Infinite if one of them is empty.
inline double least_squared_distance(const ClusterBox& a, const ClusterBox& b) {
  const auto gap = [&](int axis) { return std::max({0.0, a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]}); };
  return squared_norm(gap(0), gap(1), gap(2));
}

/// No point of `a` is farther from a point of `b`; of two points it is their distance.
inline double greatest_squared_distance(const ClusterBox& a, const ClusterBox& b) {
  const auto span = [&](int axis) { return std::max(a.high[axis] - b.low[axis], b.high[axis] - a.low[axis]); };
  return squared_norm(span(0), span(1), span(2));
}

/// If `a` is the bounding box of a set, then from every point of `b` some point of the set is at least as far.
inline double least_squared_reach(const ClusterBox& a, const ClusterBox& b) {
  const auto reach = [&](int axis) {
    return std::max({(a.high[axis] - a.low[axis]) / 2, a.high[axis] - b.high[axis], b.low[axis] - a.low[axis]});
  };
  const double greatest = std::max({reach(0), reach(1), reach(2)});
  return greatest * greatest;
}

}  // namespace trysquare::internal
