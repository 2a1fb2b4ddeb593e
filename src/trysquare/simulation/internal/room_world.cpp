// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/internal/mesh_builder.h"
#include "trysquare/simulation/internal/polyline.h"
#include "trysquare/simulation/internal/worlds.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace trysquare::internal {
namespace {

constexpr double kEyeHeight_m = 1.45;
constexpr double kTableHeight_m = 0.74;

/// Floor, ceiling and walls of a box; the corner is the origin.
void add_shell(double length_m, double width_m, double height_m, MeshBuilder& mesh) {
  mesh.add_block(rectangle({length_m / 2, width_m / 2}, length_m, width_m, 0), 0, height_m);
  mesh.add_quad({0, 0, 0}, {length_m, 0, 0}, {length_m, width_m, 0}, {0, width_m, 0});
}

void add_table(const Eigen::Vector2d& at, double length_m, double width_m, double yaw_rad, MeshBuilder& mesh) {
  constexpr double kThickness_m = 0.03;
  const Footprint top = rectangle(at, length_m, width_m, yaw_rad);
  mesh.add_block(top, kTableHeight_m - kThickness_m, kTableHeight_m);
  for (const Eigen::Vector2d& corner : top) {
    mesh.add_block(rectangle(at + 0.92 * (corner - at), 0.06, 0.06, yaw_rad), 0, kTableHeight_m);
  }
}

void add_chair(const Eigen::Vector2d& at, double yaw_rad, MeshBuilder& mesh) {
  const Eigen::Vector2d forward(std::cos(yaw_rad), std::sin(yaw_rad));
  mesh.add_block(rectangle(at, 0.44, 0.44, yaw_rad), 0.42, 0.47);
  mesh.add_block(rectangle(at - 0.2 * forward, 0.05, 0.42, yaw_rad), 0.47, 0.95);
  mesh.add_pole(at, 0.03, 0, 0.42);
}

/// Boards between two sides, with books of all sizes on them. Its back is to the left of `yaw_rad`.
void add_shelf(const Eigen::Vector2d& at, double yaw_rad, Random& random, MeshBuilder& mesh) {
  constexpr double kLength_m = 1.2;
  constexpr double kDepth_m = 0.3;
  constexpr double kLevel_m = 0.36;
  const Eigen::Vector2d along(std::cos(yaw_rad), std::sin(yaw_rad));
  for (const double end : {-kLength_m / 2, kLength_m / 2}) {
    mesh.add_block(rectangle(at + end * along, 0.03, kDepth_m, yaw_rad), 0, 5 * kLevel_m);
  }
  for (int level = 0; level < 6; ++level) {
    const double z = kLevel_m * level;
    mesh.add_block(rectangle(at, kLength_m, kDepth_m, yaw_rad), z, z + 0.02);
    if (level == 5) break;
    for (double x = -kLength_m / 2 + 0.05; x < kLength_m / 2 - 0.08;) {
      const double thickness = between(0.02, 0.07, random);
      mesh.add_block(rectangle(at + x * along, thickness, between(0.12, 0.24, random), yaw_rad), z,
                     z + between(0.15, 0.31, random));
      x += thickness + (random.uniform() < 0.15 ? 0.15 : 0.005);
    }
  }
}

void add_plant(const Eigen::Vector2d& at, Random& random, MeshBuilder& mesh) {
  mesh.add_pole(at, 0.16, 0, 0.35);
  mesh.add_foliage({at.x(), at.y(), 0.85}, {0.4, 0.4, 0.5}, 0.1, 1.5, random);
}

/// Things that lie about on a table.
void add_things(const Eigen::Vector2d& table, double yaw_rad, int num_things, Random& random, MeshBuilder& mesh) {
  for (int i = 0; i < num_things; ++i) {
    const double x = between(-0.5, 0.5, random);
    const double y = between(-0.25, 0.25, random);
    const Eigen::Vector2d along(std::cos(yaw_rad), std::sin(yaw_rad));
    const Eigen::Vector2d at = table + x * along + y * Eigen::Vector2d(-along.y(), along.x());
    const double size = between(0.05, 0.25, random);
    mesh.add_block(rectangle(at, size, between(0.05, 0.2, random), between(0, std::numbers::pi, random)),
                   kTableHeight_m, kTableHeight_m + between(0.03, 0.3, random));
  }
}

/// A desk with a screen and a chair, which look along `yaw_rad`.
void add_desk(const Eigen::Vector2d& at, double yaw_rad, Random& random, MeshBuilder& mesh) {
  const Eigen::Vector2d forward(std::cos(yaw_rad), std::sin(yaw_rad));
  const double across = yaw_rad + std::numbers::pi / 2;
  add_table(at, 1.6, 0.8, across, mesh);
  mesh.add_block(rectangle(at + 0.2 * forward, 0.6, 0.05, across + 0.1 * random.normal()), kTableHeight_m + 0.1,
                 kTableHeight_m + 0.5);
  add_things(at, across, 4, random, mesh);
  add_chair(at - between(0.6, 0.9, random) * forward, yaw_rad + 0.4 * random.normal(), mesh);
}

void add_dining_table(const Eigen::Vector2d& at, Random& random, MeshBuilder& mesh) {
  const double yaw = between(-0.4, 0.4, random);
  add_table(at, 1.5, 0.8, yaw, mesh);
  add_things(at, yaw, 8, random, mesh);
  for (int i = 0; i < 4; ++i) {
    const double angle = yaw + std::numbers::pi * (0.5 * i + 0.25);
    const Eigen::Vector2d from_table(std::cos(angle), std::sin(angle));
    add_chair(at + 0.85 * from_table, angle + std::numbers::pi + 0.2 * random.normal(), mesh);
  }
}

/// Two shelves, a sofa, a sideboard and two plants.
void add_furniture_along_walls(double length_m, double width_m, Random& random, MeshBuilder& mesh) {
  add_shelf({between(1, length_m - 1, random), width_m - 0.18}, 0, random, mesh);
  add_shelf({0.18, between(1, width_m - 1.5, random)}, std::numbers::pi / 2, random, mesh);
  const Eigen::Vector2d sofa(length_m - 0.5, between(1.5, width_m - 1.5, random));
  mesh.add_block(rectangle(sofa, 0.9, 1.9, 0), 0.1, 0.42);
  mesh.add_block(rectangle(sofa + Eigen::Vector2d(0.38, 0), 0.2, 1.9, 0), 0.42, 0.85);
  mesh.add_block(rectangle({between(1.5, length_m - 1.5, random), 0.25}, 1.4, 0.45, 0), 0, 0.8);
  add_plant({length_m - 0.5, 0.5}, random, mesh);
  add_plant({0.5, width_m - 0.5}, random, mesh);
}

/// A level ellipse at the height of a hand.
std::vector<Eigen::Vector3d> ellipse(const Eigen::Vector2d& center, double half_x_m, double half_y_m) {
  constexpr int kNumPoints = 72;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < kNumPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kNumPoints;
    points.emplace_back(center.x() + half_x_m * std::cos(angle), center.y() + half_y_m * std::sin(angle), kEyeHeight_m);
  }
  return points;
}

}  // namespace

SimulatedWorld room_world(Random& random) {
  MeshBuilder mesh;
  const double length = between(5.5, 7, random);
  const double width = between(4.5, 5.5, random);
  const Eigen::Vector2d middle(length / 2, width / 2);
  add_shell(length, width, 2.6, mesh);
  add_dining_table(middle, random, mesh);
  add_furniture_along_walls(length, width, random, mesh);
  return {
      .mesh = mesh.take(), .route_in_world = ellipse(middle, length / 2 - 1.1, width / 2 - 1.1), .route_is_loop = true};
}

namespace {

/// A floor of an office: two rows of rooms back to back in the middle, a corridor around them.
struct Office {
  static constexpr double kLength_m = 24;
  static constexpr double kWidth_m = 16;
  static constexpr double kHeight_m = 2.8;
  static constexpr double kCorridor_m = 2.2;
  static constexpr int kRooms = 5;  ///< In a row.
  static constexpr double kRoom_m = (kLength_m - 2 * kCorridor_m) / kRooms;
  static constexpr double kDepth_m = kWidth_m / 2 - kCorridor_m;
  static constexpr double kWall_m = 0.12;

  MeshBuilder mesh;
};

void add_partition(Office& office, const Eigen::Vector2d& center, double length_m, double width_m) {
  office.mesh.add_block(rectangle(center, length_m, width_m, 0), 0, Office::kHeight_m);
}

/// One room: its front with an open door, a desk, a shelf.
/// @param side  -1 or 1: of which row.
void add_room(Office& office, double left_m, double side, Random& random) {
  constexpr double kDoor_m = 1;
  const double middle = Office::kWidth_m / 2;
  const double front = middle + side * Office::kDepth_m;
  const double door = between(0.8, Office::kRoom_m - kDoor_m - 0.8, random);
  const double rest = Office::kRoom_m - door - kDoor_m;
  add_partition(office, {left_m + door / 2, front}, door, Office::kWall_m);
  add_partition(office, {left_m + Office::kRoom_m - rest / 2, front}, rest, Office::kWall_m);
  const double toward = side * std::numbers::pi / 2 + (random.uniform() < 0.5 ? 0 : std::numbers::pi);
  const double x = left_m + Office::kRoom_m / 2;
  const double desk_x = x + between(-0.7, 0.7, random);
  const double desk_y = middle + side * between(2, 3, random);
  add_desk({desk_x, desk_y}, toward + 0.1 * random.normal(), random, office.mesh);
  add_shelf({x, middle + side * 0.25}, 0, random, office.mesh);
}

void add_rooms(Office& office, Random& random) {
  const Eigen::Vector2d middle(Office::kLength_m / 2, Office::kWidth_m / 2);
  add_partition(office, middle, Office::kRooms * Office::kRoom_m, Office::kWall_m);
  for (int i = 0; i <= Office::kRooms; ++i) {
    add_partition(office, {Office::kCorridor_m + i * Office::kRoom_m, middle.y()}, Office::kWall_m,
                  2 * Office::kDepth_m);
  }
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < Office::kRooms; ++i) add_room(office, Office::kCorridor_m + i * Office::kRoom_m, side, random);
  }
}

/// Plants and cupboards along the outer wall.
void add_corridor_clutter(Office& office, Random& random) {
  constexpr int kNumThings = 8;
  for (int i = 0; i < kNumThings; ++i) {
    const double x = between(2, Office::kLength_m - 2, random);
    const double y = random.uniform() < 0.5 ? 0.3 : Office::kWidth_m - 0.3;
    if (random.uniform() < 0.5) {
      add_plant({x, y}, random, office.mesh);
    } else {
      const double length = between(0.6, 1.2, random);
      office.mesh.add_block(rectangle({x, y}, length, 0.5, 0.05 * random.normal()), 0, between(0.7, 1.8, random));
    }
  }
}

/// Once along the corridor.
std::vector<Eigen::Vector3d> corridor_route() {
  constexpr double kCorner_m = 0.8;
  constexpr double kFromWall_m = Office::kCorridor_m / 2 + 0.15;
  constexpr double kFar_m = Office::kLength_m - kFromWall_m;
  constexpr double kTop_m = Office::kWidth_m - kFromWall_m;
  const Footprint corners = {
      {{kFromWall_m, kFromWall_m}, {kFar_m, kFromWall_m}, {kFar_m, kTop_m}, {kFromWall_m, kTop_m}}};
  std::vector<Eigen::Vector2d> route;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    append_rounded_corner(corners[(k + 3) % 4], corners[k], corners[(k + 1) % 4], kCorner_m, route);
  }
  std::vector<Eigen::Vector3d> in_world;
  for (const Eigen::Vector2d& at : route) in_world.emplace_back(at.x(), at.y(), kEyeHeight_m);
  return in_world;
}

}  // namespace

SimulatedWorld office_world(Random& random) {
  Office office;
  add_shell(Office::kLength_m, Office::kWidth_m, Office::kHeight_m, office.mesh);
  add_rooms(office, random);
  add_corridor_clutter(office, random);
  return {.mesh = office.mesh.take(), .route_in_world = corridor_route(), .route_is_loop = true};
}

}  // namespace trysquare::internal
