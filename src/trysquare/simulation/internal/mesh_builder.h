// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/triangle_mesh.h"
#include "trysquare/synthetic/random.h"

#include <Eigen/Core>

#include <array>

namespace trysquare::internal {

/// Uniform in [low, high).
double between(double low, double high, Random& random);

/// Four corners, counterclockwise from above.
using Footprint = std::array<Eigen::Vector2d, 4>;

/// A rectangle about `center`; its length lies along `yaw_rad`.
Footprint rectangle(const Eigen::Vector2d& center, double length_m, double width_m, double yaw_rad);

/// The ground of an outdoor world: a tilted plane.
struct Ground {
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  double height_at_origin_m = 0;

  double height(const Eigen::Vector2d& at) const { return height_at_origin_m + slope.dot(at); }
  Eigen::Vector3d above(const Eigen::Vector2d& at, double by_m) const { return {at.x(), at.y(), height(at) + by_m}; }
};

/// Puts a mesh together from simple solids.
class MeshBuilder {
 public:
  /// Corners in order around it.
  void add_quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d);
  void add_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

  /// Walls and top of an upright prism.
  void add_block(const Footprint& footprint, double bottom_m, double top_m);

  /// Walls, and a pitched roof whose ridge lies along the first side of the footprint.
  void add_house(const Footprint& footprint, double bottom_m, double eaves_m, double ridge_m);

  /// An upright pole with eight sides.
  void add_pole(const Eigen::Vector2d& at, double radius_m, double bottom_m, double top_m);

  /// Leaves, twigs: small triangles in all directions, uniform in an ellipsoid whose half axes are given. `density` is
  /// the number of leaves that a ray through its middle meets, about: exp(-density) of the rays come through.
  void add_foliage(const Eigen::Vector3d& center, const Eigen::Vector3d& half_axes_m, double leaf_m, double density,
                   Random& random);

  void add_ground(const Ground& ground, const Eigen::Vector2d& low, const Eigen::Vector2d& high);

  TriangleMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t add_vertex(const Eigen::Vector3d& vertex);

  TriangleMesh mesh_;
};

}  // namespace trysquare::internal
