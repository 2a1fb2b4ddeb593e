// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace trysquare {

/// Surfaces as triangles; both faces of each reflect. The vertices of a mesh that stands for a thing that moves are in
/// the frame of that thing.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices_in_world;         ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles{};  ///< Indices into vertices_in_world.

  /// @throws InvalidArgument  if a vertex is not finite or an index has no vertex; the message says which.
  void validate() const;
};

}  // namespace trysquare
