// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/triangle_mesh.h"

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <span>

namespace trysquare {

/// A half line.
struct Ray {
  Eigen::Vector3d origin_in_world;     ///< [m]
  Eigen::Vector3d direction_in_world;  ///< Unit.
};

/// What a ray that hits nothing measures.
inline constexpr double kNoReturn = std::numeric_limits<double>::infinity();

/// Distances along rays to the nearest triangle of a mesh.
///
/// A search in single precision finds the triangle, double precision the distance: about the center of the mesh, so it
/// may lie anywhere on Earth. Const members may be called from several threads at once.
///
/// Accuracy: 1e-9 m in a mesh of 1 km (ray_caster_test.cpp). Which of two triangles a ray sees is decided to 1e-7 of
/// the
///           extent of the mesh.
/// Cost:     about 200 bytes a triangle; millions of rays a second (benchmarks/README.md).
class RayCaster {
 public:
  /// @param mesh_in_world  is copied. Triangles without area are never hit.
  /// @throws InvalidArgument  if the mesh is invalid.
  explicit RayCaster(const TriangleMesh& mesh_in_world);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// Rays that are neighbors in the span should be neighbors in space: that makes the search fast.
  /// @param max_range_m  Where rays end: nearer triangles are hit.
  /// @param ranges_m     One for each ray [m], kNoReturn where nothing is hit.
  void cast(std::span<const Ray> rays, double max_range_m, std::span<double> ranges_m) const;

  /// The same for one ray.
  double cast(const Ray& ray, double max_range_m = kNoReturn) const;

 private:
  class Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace trysquare
