// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/simulation/internal/mesh_builder.h"
#include "trysquare/simulation/moving_object.h"

#include <Eigen/Core>

#include <vector>

namespace trysquare::internal {

/// How high a sensor on a roof is carried above the street.
inline constexpr double kSensorHeight_m = 1.8;

/// A car of 4.2 by 1.8 by 1.5 m: body and cabin.
void add_car(const Eigen::Vector2d& at, double yaw_rad, const Ground& ground, MeshBuilder& mesh);

/// A trunk and a crown of leaves.
void add_tree(const Eigen::Vector2d& at, double height_m, const Ground& ground, Random& random, MeshBuilder& mesh);

/// A wall of leaves from one point to another.
void add_hedge(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height_m, const Ground& ground,
               Random& random, MeshBuilder& mesh);

/// Cars that drive along a route of sensor positions, on the other side of the street and the other way.
/// @param offset_m  To the left of the route.
std::vector<MovingObject> oncoming_cars(const std::vector<Eigen::Vector3d>& route, bool is_loop, double offset_m,
                                        int num_cars, Random& random);

}  // namespace trysquare::internal
