// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/internal/mesh_builder.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace trysquare::internal {
namespace {

Eigen::Vector3d lifted(const Eigen::Vector2d& at, double height_m) { return {at.x(), at.y(), height_m}; }

}  // namespace

double between(double low, double high, Random& random) { return low + (high - low) * random.uniform(); }

Footprint rectangle(const Eigen::Vector2d& center, double length_m, double width_m, double yaw_rad) {
  const Eigen::Vector2d along = length_m / 2 * Eigen::Vector2d(std::cos(yaw_rad), std::sin(yaw_rad));
  const Eigen::Vector2d across = width_m / 2 * Eigen::Vector2d(-std::sin(yaw_rad), std::cos(yaw_rad));
  return {center - along - across, center + along - across, center + along + across, center - along + across};
}

std::uint32_t MeshBuilder::add_vertex(const Eigen::Vector3d& vertex) {
  mesh_.vertices_in_world.push_back(vertex);
  return static_cast<std::uint32_t>(mesh_.vertices_in_world.size() - 1);
}

void MeshBuilder::add_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const std::uint32_t first = add_vertex(a);
  add_vertex(b);
  add_vertex(c);
  mesh_.triangles.push_back({first, first + 1, first + 2});
}

void MeshBuilder::add_quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                           const Eigen::Vector3d& d) {
  const std::uint32_t first = add_vertex(a);
  add_vertex(b);
  add_vertex(c);
  add_vertex(d);
  mesh_.triangles.push_back({first, first + 1, first + 2});
  mesh_.triangles.push_back({first, first + 2, first + 3});
}

void MeshBuilder::add_block(const Footprint& footprint, double bottom_m, double top_m) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& a = footprint[i];
    const Eigen::Vector2d& b = footprint[(i + 1) % 4];
    add_quad(lifted(a, bottom_m), lifted(b, bottom_m), lifted(b, top_m), lifted(a, top_m));
  }
  add_quad(lifted(footprint[0], top_m), lifted(footprint[1], top_m), lifted(footprint[2], top_m),
           lifted(footprint[3], top_m));
}

void MeshBuilder::add_house(const Footprint& footprint, double bottom_m, double eaves_m, double ridge_m) {
  const auto& [a, b, c, d] = footprint;
  const Eigen::Vector3d ridge_begin = lifted((a + d) / 2, ridge_m);
  const Eigen::Vector3d ridge_end = lifted((b + c) / 2, ridge_m);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& from = footprint[i];
    const Eigen::Vector2d& to = footprint[(i + 1) % 4];
    add_quad(lifted(from, bottom_m), lifted(to, bottom_m), lifted(to, eaves_m), lifted(from, eaves_m));
  }
  add_quad(lifted(a, eaves_m), lifted(b, eaves_m), ridge_end, ridge_begin);
  add_quad(lifted(c, eaves_m), lifted(d, eaves_m), ridge_begin, ridge_end);
  add_triangle(lifted(b, eaves_m), lifted(c, eaves_m), ridge_end);
  add_triangle(lifted(d, eaves_m), lifted(a, eaves_m), ridge_begin);
}

void MeshBuilder::add_pole(const Eigen::Vector2d& at, double radius_m, double bottom_m, double top_m) {
  constexpr int kSides = 8;
  const auto corner = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    return Eigen::Vector2d(at + radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  };
  for (int i = 0; i < kSides; ++i) {
    const Eigen::Vector2d a = corner(i);
    const Eigen::Vector2d b = corner(i + 1);
    add_quad(lifted(a, bottom_m), lifted(b, bottom_m), lifted(b, top_m), lifted(a, top_m));
    add_triangle(lifted(a, top_m), lifted(b, top_m), lifted(at, top_m));
  }
}

void MeshBuilder::add_foliage(const Eigen::Vector3d& center, const Eigen::Vector3d& half_axes_m, double leaf_m,
                              double density, Random& random) {
  // Corners that are normal about the middle with leaf_m / 2 make triangles as large, in the mean, as an equilateral
  // one with sides of leaf_m; in the mean over all directions half of that is seen.
  const double shown_m2 = 0.5 * std::sqrt(3.0) / 4 * leaf_m * leaf_m;
  const double seen_m2 = std::numbers::pi * half_axes_m.head<2>().mean() * half_axes_m.z();
  const int num_leaves = static_cast<int>(std::ceil(density * seen_m2 / shown_m2));
  for (int i = 0; i < num_leaves; ++i) {
    const Eigen::Vector3d in_ball = std::cbrt(random.uniform()) * random.unit_direction();
    const Eigen::Vector3d middle = center + half_axes_m.cwiseProduct(in_ball);
    const Eigen::Vector3d a = middle + leaf_m / 2 * random.normal_vector();
    const Eigen::Vector3d b = middle + leaf_m / 2 * random.normal_vector();
    add_triangle(a, b, middle + leaf_m / 2 * random.normal_vector());
  }
}

void MeshBuilder::add_ground(const Ground& ground, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  add_quad(ground.above(low, 0), ground.above({high.x(), low.y()}, 0), ground.above(high, 0),
           ground.above({low.x(), high.y()}, 0));
}

}  // namespace trysquare::internal
