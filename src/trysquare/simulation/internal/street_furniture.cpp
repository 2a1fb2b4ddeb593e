// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/internal/street_furniture.h"

#include "trysquare/simulation/internal/polyline.h"

#include <algorithm>
#include <cmath>

namespace trysquare::internal {
namespace {

constexpr double kLeaf_m = 0.25;  ///< A twig's worth of leaves: smaller ones would only cost memory.

/// On its wheels at `bottom_m`: the body begins above the ground.
void add_car_at(const Eigen::Vector2d& at, double yaw_rad, double bottom_m, MeshBuilder& mesh) {
  const Eigen::Vector2d forward(std::cos(yaw_rad), std::sin(yaw_rad));
  mesh.add_block(rectangle(at, 4.2, 1.8, yaw_rad), bottom_m + 0.2, bottom_m + 0.85);
  mesh.add_block(rectangle(at - 0.3 * forward, 2.2, 1.6, yaw_rad), bottom_m + 0.85, bottom_m + 1.5);
}

}  // namespace

void add_car(const Eigen::Vector2d& at, double yaw_rad, const Ground& ground, MeshBuilder& mesh) {
  add_car_at(at, yaw_rad, ground.height(at), mesh);
}

void add_tree(const Eigen::Vector2d& at, double height_m, const Ground& ground, Random& random, MeshBuilder& mesh) {
  const double crown_m = between(0.55, 0.7, random) * height_m;
  const double bottom_m = ground.height(at);
  mesh.add_pole(at, between(0.08, 0.25, random), bottom_m - 0.5, bottom_m + height_m - crown_m / 2);
  const double spread_m = crown_m * between(0.35, 0.5, random);
  mesh.add_foliage({at.x(), at.y(), bottom_m + height_m - crown_m / 2}, {spread_m, spread_m, crown_m / 2}, kLeaf_m,
                   between(0.8, 2, random), random);
}

void add_hedge(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height_m, const Ground& ground,
               Random& random, MeshBuilder& mesh) {
  constexpr double kStep_m = 0.8;
  const int num_bushes = std::max(1, static_cast<int>((to - from).norm() / kStep_m));
  for (int i = 0; i < num_bushes; ++i) {
    const Eigen::Vector2d at = from + (i + 0.5) / num_bushes * (to - from);
    const double half_m = height_m / 2 * between(0.85, 1.15, random);
    mesh.add_foliage(ground.above(at, half_m), {0.55, 0.55, half_m}, kLeaf_m, 2.5, random);
  }
}

std::vector<MovingObject> oncoming_cars(const std::vector<Eigen::Vector3d>& route, bool is_loop, double offset_m,
                                        int num_cars, Random& random) {
  constexpr double kStep_m = 2;
  if (num_cars == 0) return {};
  const Polyline way(route, is_loop);
  const double length = way.length_m();
  std::vector<Eigen::Vector3d> path;
  const int num_points = std::max(2, static_cast<int>(length / kStep_m));
  for (int i = 0; i <= num_points; ++i) {
    const double s = length * (num_points - i) / num_points;
    const Eigen::Vector3d left = rotation_looking(way.ahead(s, kStep_m)).col(1);
    path.emplace_back(way.at(s) + offset_m * left - kSensorHeight_m * Eigen::Vector3d::UnitZ());
  }
  if (is_loop) path.back() = path.front();
  std::vector<MovingObject> cars;
  for (int i = 0; i < num_cars; ++i) {
    MeshBuilder mesh;
    add_car_at({0, 0}, 0, 0, mesh);
    cars.push_back({mesh.take(), path, length * (i + random.uniform()) / num_cars, between(6, 12, random)});
  }
  return cars;
}

}  // namespace trysquare::internal
