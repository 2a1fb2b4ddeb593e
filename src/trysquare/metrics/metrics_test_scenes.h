// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/registered_map.h"
#include "trysquare/metrics/orthogonal_subset.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

/// Scenes for the tests of this folder: three mutually orthogonal walls, seen by several scans.
namespace trysquare::test {

struct Scene {
  RegisteredMap map;
  OrthogonalSubset subset;
};

/// Walls x = 0, y = 0, z = 0 of 4 m edge, three from each other, with Gaussian noise along their normals; the points in
/// the middle of each wall are the subset.
inline Scene three_walls(double sigma_m, std::size_t points_per_wall_and_scan = 400, std::size_t num_scans = 4,
                         unsigned seed = 1) {
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> in_wall(0.0, 4.0);
  std::normal_distribution<double> noise(0.0, 1.0);
  Scene scene;
  scene.map.num_scans = num_scans;
  scene.subset.directions.resize(3);
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    scene.subset.directions[static_cast<std::size_t>(axis)].normal_in_map[axis] = 1;
  for (std::uint32_t scan = 0; scan < num_scans; ++scan) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < points_per_wall_and_scan; ++i) {
        Eigen::Vector3d point = Eigen::Vector3d::Constant(6);  // keeps the walls 2 m from each other
        point[axis] = sigma_m * noise(rng);
        point[(axis + 1) % 3] += in_wall(rng);
        point[(axis + 2) % 3] += in_wall(rng);
        scene.map.points_in_map.push_back(point);
        scene.map.scan_of_point.push_back(scan);
        const bool in_the_middle = std::abs(point[(axis + 1) % 3] - 8) < 1 && std::abs(point[(axis + 2) % 3] - 8) < 1;
        if (in_the_middle) scene.subset.directions[static_cast<std::size_t>(axis)].points_in_map.push_back(point);
      }
    }
  }
  return scene;
}

/// The scene after point → scale · (rotation · point) + shift.
inline Scene transformed(Scene scene, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& shift, double scale = 1) {
  const auto move = [&](Eigen::Vector3d& point) { point = scale * (rotation * point) + shift; };
  for (Eigen::Vector3d& point : scene.map.points_in_map) move(point);
  for (OrthogonalSubset::Direction& direction : scene.subset.directions) {
    direction.normal_in_map = rotation * direction.normal_in_map;
    for (Eigen::Vector3d& point : direction.points_in_map) move(point);
  }
  return scene;
}

inline Eigen::Matrix3d some_rotation() {
  return Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
}

}  // namespace trysquare::test
