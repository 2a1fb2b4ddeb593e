// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/triangle_mesh.h"

#include "trysquare/core/error.h"

#include <cstddef>
#include <string>

namespace trysquare {

void TriangleMesh::validate() const {
  for (std::size_t i = 0; i < vertices_in_world.size(); ++i) {
    if (!vertices_in_world[i].allFinite()) throw InvalidArgument("vertex " + std::to_string(i) + " is not finite");
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t vertex : triangles[i]) {
      if (vertex < vertices_in_world.size()) continue;
      throw InvalidArgument("triangle " + std::to_string(i) + " names vertex " + std::to_string(vertex) +
                            ", but there are " + std::to_string(vertices_in_world.size()));
    }
  }
}

}  // namespace trysquare
