// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/triangle_mesh.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace trysquare::internal {

/// Puts a mesh together and refuses what is none. `where` is the start of a message, "<name>: line N: ".
class MeshCollector {
 public:
  explicit MeshCollector(std::string_view name) : name_(name) {}

  std::size_t num_vertices() const { return mesh_.vertices_in_world.size(); }

  /// @throws IoError  if it is not finite, or there are too many.
  void add_vertex(const Eigen::Vector3d& vertex, const std::string& where);

  /// Cuts a polygon into triangles that share its first corner.
  /// @param corners   Numbers of vertices from 0, which may come later.
  /// @throws IoError  if it has less than three, or one is no such number.
  void add_polygon(std::span<const double> corners, const std::string& where);

  /// @throws IoError  if there is no triangle, or one has a vertex that never came.
  TriangleMesh take();

 private:
  std::string name_;
  TriangleMesh mesh_;
  double largest_corner_ = -1;
  std::string where_largest_;
};

}  // namespace trysquare::internal
