// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <vector>

namespace trysquare::internal {

/// A way through points, by its length.
class Polyline {
 public:
  /// REQUIRES two points that differ.
  /// @param is_loop  From the last point back to the first.
  Polyline(std::vector<Eigen::Vector3d> points, bool is_loop);

  double length_m() const { return at_m_.back(); }
  bool is_loop() const { return is_loop_; }

  /// The point after `s_m` of the way; on a loop again and again, else no farther than its ends.
  Eigen::Vector3d at(double s_m) const;

  /// Unit direction of the chord of `reach_m` to both sides of a point: turns smoothly where the line has a corner.
  Eigen::Vector3d ahead(double s_m, double reach_m) const;

 private:
  std::vector<Eigen::Vector3d> points_;  ///< Of a loop, the first one again at the end.
  std::vector<double> at_m_;
  bool is_loop_;
};

/// Adds the way around a corner: from radius_m before it to radius_m behind it, in twelve steps.
void append_rounded_corner(const Eigen::Vector2d& before, const Eigen::Vector2d& corner, const Eigen::Vector2d& after,
                           double radius_m, std::vector<Eigen::Vector2d>& route);

/// x along `forward`, y level, z up. REQUIRES a direction that is not vertical.
Eigen::Matrix3d rotation_looking(const Eigen::Vector3d& forward);

}  // namespace trysquare::internal
