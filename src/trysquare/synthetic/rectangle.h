// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace trysquare {

/// A flat piece of a scene: corner + u · side_u + v · side_v for u, v in [0, 1]. The sides are perpendicular, both
/// faces reflect.
struct Rectangle {
  Eigen::Vector3d corner;  ///< [m], world frame, as all members.
  Eigen::Vector3d side_u;
  Eigen::Vector3d side_v;

  Eigen::Vector3d normal() const;  ///< Unit.
};

/// The six faces of a box whose edges are parallel to the axes.
std::vector<Rectangle> box(const Eigen::Vector3d& lowest_corner, const Eigen::Vector3d& size);

/// Distance from `origin` to `rectangle` along the unit vector `direction` [m]; nullopt when the ray passes it by,
/// starts on it or lies in its plane.
std::optional<double> distance_along_ray(const Rectangle& rectangle, const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& direction);

/// Where a ray ends.
struct Hit {
  double distance_m = 0;
  std::size_t rectangle_index = 0;
};

/// The nearest rectangle along a ray: what a sensor sees. nullopt: the sky.
std::optional<Hit> cast_ray(std::span<const Rectangle> scene, const Eigen::Vector3d& origin,
                            const Eigen::Vector3d& direction);

}  // namespace trysquare
