// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/rectangle.h"

#include <Eigen/Geometry>

namespace trysquare {

Eigen::Vector3d Rectangle::normal() const { return side_u.cross(side_v).normalized(); }

std::vector<Rectangle> box(const Eigen::Vector3d& lowest_corner, const Eigen::Vector3d& size) {
  const Eigen::Vector3d x(size.x(), 0, 0);
  const Eigen::Vector3d y(0, size.y(), 0);
  const Eigen::Vector3d z(0, 0, size.z());
  return {{lowest_corner, x, y},     {lowest_corner, y, z},     {lowest_corner, z, x},
          {lowest_corner + z, x, y}, {lowest_corner + x, y, z}, {lowest_corner + y, z, x}};
}

std::optional<double> distance_along_ray(const Rectangle& rectangle, const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& direction) {
  const Eigen::Vector3d normal = rectangle.side_u.cross(rectangle.side_v);
  const double approach = normal.dot(direction);
  if (approach == 0) return std::nullopt;
  const double distance = normal.dot(rectangle.corner - origin) / approach;
  if (!(distance > 0)) return std::nullopt;
  const Eigen::Vector3d at = origin + distance * direction - rectangle.corner;
  const double u = at.dot(rectangle.side_u) / rectangle.side_u.squaredNorm();
  const double v = at.dot(rectangle.side_v) / rectangle.side_v.squaredNorm();
  if (u < 0 || u > 1 || v < 0 || v > 1) return std::nullopt;
  return distance;
}

std::optional<Hit> cast_ray(std::span<const Rectangle> scene, const Eigen::Vector3d& origin,
                            const Eigen::Vector3d& direction) {
  std::optional<Hit> nearest;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const std::optional<double> distance = distance_along_ray(scene[i], origin, direction);
    if (distance && (!nearest || *distance < nearest->distance_m)) nearest = Hit{*distance, i};
  }
  return nearest;
}

}  // namespace trysquare
