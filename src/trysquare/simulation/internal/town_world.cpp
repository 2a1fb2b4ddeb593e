// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/internal/mesh_builder.h"
#include "trysquare/simulation/internal/polyline.h"
#include "trysquare/simulation/internal/street_furniture.h"
#include "trysquare/simulation/internal/worlds.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace trysquare::internal {
namespace {

constexpr int kNumNodes = 6;  ///< Crossings each way; the outermost are the edge of the town and are not driven to.
constexpr double kFoundation_m = 6;  ///< Into the ground, which may be steep.

struct Range {
  double low = 0;
  double high = 0;
};

/// What a town looks like. Lengths in metres.
struct Character {
  double block = 70;          ///< From crossing to crossing.
  double street_width = 16;   ///< From property to property.
  double node_jitter = 0;     ///< Crossings are off the grid by up to this.
  double corner_radius = 7;   ///< Of the route.
  Range frontage;             ///< Of buildings along the street.
  Range depth;                ///< Of buildings away from the street.
  Range height;               ///< Of walls.
  Range roof;                 ///< Of the ridge above the walls; 0: flat.
  Range gap;                  ///< Between buildings.
  Range setback;              ///< From the property line.
  double yaw_sigma = 0;       ///< Of buildings [rad].
  double crookedness = 0;     ///< Corners of buildings are off by up to this.
  double slope_sigma = 0;     ///< Of the ground, both ways.
  double trees_per_100m = 0;  ///< Along each side of a street.
  double cars_per_100m = 0;
  double poles_per_100m = 0;
  bool has_gardens = false;  ///< Hedges at the property line, garden trees.
};

Character character_of(WorldStyle style) {
  if (style == WorldStyle::kTownGrid) {
    return {.frontage = {14, 30},
            .depth = {14, 20},
            .height = {12, 40},
            .gap = {0, 3},
            .setback = {0, 1.5},
            .yaw_sigma = 0.003,
            .slope_sigma = 0.005,
            .trees_per_100m = 4,
            .cars_per_100m = 8,
            .poles_per_100m = 5};
  }
  if (style == WorldStyle::kTownSuburb) {
    return {.node_jitter = 6,
            .frontage = {9, 15},
            .depth = {8, 11},
            .height = {3, 6},
            .roof = {2, 4},
            .gap = {5, 12},
            .setback = {4, 8},
            .yaw_sigma = 0.12,
            .slope_sigma = 0.015,
            .trees_per_100m = 2,
            .cars_per_100m = 3,
            .poles_per_100m = 3,
            .has_gardens = true};
  }
  return {.block = 66,
          .street_width = 9,
          .node_jitter = 11,
          .corner_radius = 4,
          .frontage = {6, 12},
          .depth = {8, 12},
          .height = {6, 13},
          .roof = {2, 5},
          .gap = {0, 0.4},
          .setback = {0, 0.8},
          .yaw_sigma = 0.04,
          .crookedness = 0.5,
          .slope_sigma = 0.03,
          .cars_per_100m = 2,
          .poles_per_100m = 4};
}

double drawn(const Range& range, Random& random) { return between(range.low, range.high, random); }

struct Town {
  Character character;
  std::array<std::array<Eigen::Vector2d, kNumNodes>, kNumNodes> nodes;  ///< [column][row]
  Ground ground;
  MeshBuilder mesh;
};

void place_nodes(Town& town, Random& random) {
  const double half = town.character.block * (kNumNodes - 1) / 2;
  for (int i = 0; i < kNumNodes; ++i) {
    for (int j = 0; j < kNumNodes; ++j) {
      const double jitter = town.character.node_jitter;
      const double x = town.character.block * i - half + between(-jitter, jitter, random);
      const double y = town.character.block * j - half + between(-jitter, jitter, random);
      town.nodes.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j)) = {x, y};
    }
  }
}

Eigen::Vector2d left_of(const Eigen::Vector2d& direction) { return {-direction.y(), direction.x()}; }

/// Where the lines a + s · u and b + t · v meet. REQUIRES that they are not parallel.
Eigen::Vector2d crossing(const Eigen::Vector2d& a, const Eigen::Vector2d& u, const Eigen::Vector2d& b,
                         const Eigen::Vector2d& v) {
  const double s = (b - a).dot(left_of(v)) / u.dot(left_of(v));
  return a + s * u;
}

/// The quadrilateral between four crossings, without the half streets around it.
Footprint property(const Footprint& crossings, double half_street_m) {
  Footprint corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& at = crossings[i];
    const Eigen::Vector2d in = (at - crossings[(i + 3) % 4]).normalized();
    const Eigen::Vector2d out = (crossings[(i + 1) % 4] - at).normalized();
    corners[i] = crossing(at + half_street_m * left_of(in), in, at + half_street_m * left_of(out), out);
  }
  return corners;
}

void add_building(Town& town, const Eigen::Vector2d& center, double frontage_m, double depth_m, double yaw_rad,
                  Random& random) {
  Footprint footprint = rectangle(center, frontage_m, depth_m, yaw_rad);
  for (Eigen::Vector2d& corner : footprint) {
    const double off = town.character.crookedness;
    const double x = between(-off, off, random);
    corner += Eigen::Vector2d(x, between(-off, off, random));
  }
  const double ground = town.ground.height(center);
  const double eaves = ground + drawn(town.character.height, random);
  const double roof = drawn(town.character.roof, random);
  if (roof > 0) {
    town.mesh.add_house(footprint, ground - kFoundation_m, eaves, eaves + roof);
  } else {
    town.mesh.add_block(footprint, ground - kFoundation_m, eaves);
  }
}

/// Buildings along one side of a block, seen from whose street the block is to the left.
void add_buildings(Town& town, const Eigen::Vector2d& from, const Eigen::Vector2d& to, Random& random) {
  const Character& character = town.character;
  const double length = (to - from).norm();
  const Eigen::Vector2d along = (to - from) / length;
  const double yaw = std::atan2(along.y(), along.x());
  for (double at = drawn(character.gap, random) / 2; at < length;) {
    double frontage = drawn(character.frontage, random);
    const double rest = length - at;
    if (rest < 0.6 * character.frontage.low) break;
    frontage = std::min(frontage, rest);
    const double depth = drawn(character.depth, random);
    const Eigen::Vector2d center =
        from + (at + frontage / 2) * along + (drawn(character.setback, random) + depth / 2) * left_of(along);
    add_building(town, center, frontage, depth, yaw + character.yaw_sigma * random.normal(), random);
    at += frontage + drawn(character.gap, random);
  }
}

/// Hedges with a gap for the gate, and trees behind them.
void add_garden(Town& town, const Eigen::Vector2d& from, const Eigen::Vector2d& to, Random& random) {
  constexpr double kGate_m = 3;
  const double length = (to - from).norm();
  const Eigen::Vector2d along = (to - from) / length;
  for (double at = 0; at < length;) {
    const double piece = std::min(between(8, 18, random), length - at);
    const Eigen::Vector2d begin = from + at * along;
    if (random.uniform() < 0.65) {
      add_hedge(begin, begin + piece * along, between(0.8, 1.8, random), town.ground, random, town.mesh);
    }
    if (random.uniform() < 0.5) {
      add_tree(begin + piece / 2 * along + between(1.5, 3.5, random) * left_of(along), between(4, 8, random),
               town.ground, random, town.mesh);
    }
    at += piece + kGate_m;
  }
}

/// What stands in the street, within `half_street_m` of the property line.
void add_street_clutter(Town& town, const Eigen::Vector2d& from, const Eigen::Vector2d& to, Random& random) {
  const Character& character = town.character;
  const double length = (to - from).norm();
  const Eigen::Vector2d along = (to - from) / length;
  const Eigen::Vector2d to_street = -left_of(along);
  const auto place = [&](double low_m, double high_m) {
    const double at = between(3, length - 3, random);
    return Eigen::Vector2d(from + at * along + between(low_m, high_m, random) * to_street);
  };
  const auto num = [&](double per_100m) { return static_cast<int>(std::lround(per_100m * length / 100)); };
  const double yaw = std::atan2(along.y(), along.x());
  const double kerb_m = 0.2 * character.street_width;
  for (int i = 0; i < num(character.cars_per_100m); ++i) {
    const Eigen::Vector2d at = place(kerb_m - 0.2, kerb_m + 0.2);
    add_car(at, yaw + 0.03 * random.normal(), town.ground, town.mesh);
  }
  for (int i = 0; i < num(character.poles_per_100m); ++i) {
    const Eigen::Vector2d at = place(0.2, kerb_m - 1);
    const double bottom = town.ground.height(at);
    town.mesh.add_pole(at, between(0.05, 0.15, random), bottom - 1, bottom + between(3, 8, random));
  }
  for (int i = 0; i < num(character.trees_per_100m); ++i) {
    const Eigen::Vector2d at = place(0.8, kerb_m - 0.8);
    add_tree(at, between(5, 9, random), town.ground, random, town.mesh);
  }
}

void add_blocks(Town& town, Random& random) {
  for (std::size_t i = 0; i + 1 < kNumNodes; ++i) {
    for (std::size_t j = 0; j + 1 < kNumNodes; ++j) {
      const auto& nodes = town.nodes;
      const Footprint corners = property({nodes[i][j], nodes[i + 1][j], nodes[i + 1][j + 1], nodes[i][j + 1]},
                                         town.character.street_width / 2);
      for (std::size_t k = 0; k < 4; ++k) {
        add_buildings(town, corners[k], corners[(k + 1) % 4], random);
        if (town.character.has_gardens) add_garden(town, corners[k], corners[(k + 1) % 4], random);
        add_street_clutter(town, corners[k], corners[(k + 1) % 4], random);
      }
    }
  }
}

/// A loop past all inner crossings: long streets, left and right turns.
std::vector<Eigen::Vector3d> route_through(const Town& town) {
  constexpr std::array<std::pair<std::size_t, std::size_t>, 16> kLoop = {{{1, 1},
                                                                          {2, 1},
                                                                          {3, 1},
                                                                          {4, 1},
                                                                          {4, 2},
                                                                          {3, 2},
                                                                          {2, 2},
                                                                          {2, 3},
                                                                          {3, 3},
                                                                          {4, 3},
                                                                          {4, 4},
                                                                          {3, 4},
                                                                          {2, 4},
                                                                          {1, 4},
                                                                          {1, 3},
                                                                          {1, 2}}};
  std::vector<Eigen::Vector2d> corners;
  for (const auto& [i, j] : kLoop) corners.push_back(town.nodes.at(i).at(j));
  std::vector<Eigen::Vector2d> route;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    append_rounded_corner(corners[(k + corners.size() - 1) % corners.size()], corners[k],
                          corners[(k + 1) % corners.size()], town.character.corner_radius, route);
  }
  std::vector<Eigen::Vector3d> in_world;
  for (const Eigen::Vector2d& at : route) in_world.push_back(town.ground.above(at, kSensorHeight_m));
  return in_world;
}

}  // namespace

SimulatedWorld town_world(WorldStyle style, const WorldSettings& settings, Random& random) {
  Town town{.character = character_of(style)};
  const double slope_x = town.character.slope_sigma * random.normal();
  town.ground.slope = {slope_x, town.character.slope_sigma * random.normal()};
  place_nodes(town, random);
  const double edge = town.character.block * kNumNodes / 2 + 100;
  town.mesh.add_ground(town.ground, {-edge, -edge}, {edge, edge});
  add_blocks(town, random);
  SimulatedWorld world{.mesh = town.mesh.take(), .route_in_world = route_through(town), .route_is_loop = true};
  const double offset = style == WorldStyle::kTownOld ? 1.5 : 3;
  world.moving = oncoming_cars(world.route_in_world, true, offset, settings.num_moving_cars, random);
  return world;
}

}  // namespace trysquare::internal
