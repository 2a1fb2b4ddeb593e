// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/mesh_collector.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace trysquare::internal {
namespace {

constexpr double kMostVertices = std::numeric_limits<std::uint32_t>::max();

}  // namespace

void MeshCollector::add_vertex(const Eigen::Vector3d& vertex, const std::string& where) {
  if (!vertex.allFinite()) {
    throw IoError(fmt::format("{}found a vertex ({}, {}, {}), expected three finite numbers", where, vertex.x(),
                              vertex.y(), vertex.z()));
  }
  if (static_cast<double>(num_vertices()) >= kMostVertices) throw IoError(where + "found more than 2^32 - 1 vertices");
  mesh_.vertices_in_world.push_back(vertex);
}

void MeshCollector::add_polygon(std::span<const double> corners, const std::string& where) {
  if (corners.size() < 3) {
    throw IoError(fmt::format("{}found a polygon of {} corners, expected 3 or more", where, corners.size()));
  }
  for (const double corner : corners) {
    if (!(corner >= 0 && corner < kMostVertices && corner == std::floor(corner))) {
      throw IoError(fmt::format("{}found a corner that is vertex {} from 0, which cannot be", where, corner));
    }
    if (corner <= largest_corner_) continue;
    largest_corner_ = corner;
    where_largest_ = where;
  }
  const auto index = [&](std::size_t i) { return static_cast<std::uint32_t>(corners[i]); };
  for (std::size_t i = 2; i < corners.size(); ++i) mesh_.triangles.push_back({index(0), index(i - 1), index(i)});
}

TriangleMesh MeshCollector::take() {
  if (mesh_.triangles.empty()) throw IoError(fmt::format("{}: the file has no triangle in it", name_));
  if (largest_corner_ >= static_cast<double>(num_vertices())) {
    throw IoError(fmt::format("{}found a corner that is vertex {} from 0, but there are {} vertices", where_largest_,
                              largest_corner_, num_vertices()));
  }
  return std::move(mesh_);
}

}  // namespace trysquare::internal
