// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/internal/mesh_builder.h"
#include "trysquare/simulation/internal/street_furniture.h"
#include "trysquare/simulation/internal/worlds.h"

#include <array>
#include <cmath>

namespace trysquare::internal {
namespace {

constexpr double kBefore_m = 25;     ///< Buildings begin so far behind the start of the route ...
constexpr double kBehind_m = 5;      ///< ... and end so far behind its end.
constexpr double kFoundation_m = 2;  ///< Into the ground, which is not level.

struct Street {
  double length_m = 0;
  Ground ground;
  MeshBuilder mesh;

  double density(double per_85_m) const { return per_85_m / 85 * (length_m + kBefore_m); }
};

double side(Random& random) { return random.uniform() < 0.5 ? -1 : 1; }

void add_building(Street& street, const Eigen::Vector2d& center, double length_m, double width_m, double yaw_rad,
                  double height_m) {
  const double bottom = street.ground.height(center);
  street.mesh.add_block(rectangle(center, length_m, width_m, yaw_rad), bottom - kFoundation_m, bottom + height_m);
}

/// Both rows of buildings; a share of them, which differs from street to street, is askew.
void add_buildings(Street& street, Random& random) {
  constexpr std::array<double, 5> kShares = {0, 0.35, 0.6, 0.12, 0};
  const double share_askew = kShares.at(static_cast<std::size_t>(5 * random.uniform()));
  for (const double row : {-1.0, 1.0}) {
    for (double x = -kBefore_m; x < street.length_m + kBehind_m;) {
      const double length_m = between(6, 18, random);
      const double width_m = between(6, 14, random);
      const double height_m = between(4, 14, random);
      const double y = row * (between(7, 12, random) + width_m / 2);
      double yaw = 0.02 * random.normal();
      if (random.uniform() < share_askew) yaw = between(-0.7, 0.7, random);
      add_building(street, {x + length_m / 2, y}, length_m, width_m, yaw, height_m);
      x += length_m + between(0.5, 9, random);
    }
  }
}

void add_ends(Street& street, Random& random) {
  for (const double x : {-kBefore_m - 15, street.length_m + 25}) {
    add_building(street, {x, 0}, 8, 50, 0.02 * random.normal(), 13.8);
  }
}

void add_clutter(Street& street, Random& random) {
  const double end = street.length_m;
  for (int i = 0; i < street.density(15); ++i) {
    const Eigen::Vector2d at(between(-15, end - 5, random), side(random) * between(4.2, 5.2, random));
    add_car(at, 0.05 * random.normal(), street.ground, street.mesh);
  }
  for (int i = 0; i < street.density(22); ++i) {
    const Eigen::Vector2d at(between(-kBefore_m, end, random), side(random) * between(5.4, 6.8, random));
    const double bottom = street.ground.height(at);
    street.mesh.add_pole(at, between(0.06, 0.35, random), bottom - kFoundation_m,
                         bottom + kSensorHeight_m + between(1, 6, random));
  }
  for (int i = 0; i < street.density(45); ++i) {
    const Eigen::Vector2d at(between(-kBefore_m, end, random), side(random) * between(5.4, 9, random));
    const double radius_m = between(0.25, 1.3, random);
    street.mesh.add_foliage(street.ground.above(at, kSensorHeight_m + between(-1.5, 4, random)),
                            Eigen::Vector3d::Constant(radius_m), 0.15, between(0.7, 1.5, random), random);
  }
}

}  // namespace

SimulatedWorld street_world(const WorldSettings& settings, Random& random) {
  Street street{.length_m = settings.street_length_m};
  const double slope_x = 0.01 * random.normal();
  street.ground = {{slope_x, 0.01 * random.normal()}, -kSensorHeight_m};
  street.mesh.add_ground(street.ground, {-100, -100}, {street.length_m + 100, 100});
  add_buildings(street, random);
  add_ends(street, random);
  add_clutter(street, random);
  SimulatedWorld world;
  const double y = between(-1, 1, random);
  for (const double x : {0.0, street.length_m}) {
    world.route_in_world.push_back(street.ground.above({x, y}, kSensorHeight_m));
  }
  world.mesh = street.mesh.take();
  world.moving = oncoming_cars(world.route_in_world, false, 2.5, settings.num_moving_cars, random);
  return world;
}

}  // namespace trysquare::internal
