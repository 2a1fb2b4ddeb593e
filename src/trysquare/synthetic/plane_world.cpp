// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/plane_world.h"

#include "trysquare/core/error.h"
#include "trysquare/synthetic/random.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace trysquare {
namespace {

void require_discs(std::span<const Disc> discs) {
  for (std::size_t i = 0; i < discs.size(); ++i) {
    if (discs[i].num_points == 0U) {
      throw InvalidArgument("disc " + std::to_string(i) + " has num_points = 0: it must be >= 1");
    }
    if (std::abs(discs[i].normal_in_world.norm() - 1) < 1e-9) continue;
    throw InvalidArgument("the normal of disc " + std::to_string(i) + " is not of length 1");
  }
}

Eigen::Vector3d point_on_disc(const Disc& disc, const PlaneWorldSettings& settings, Random& random) {
  const Eigen::Vector3d u = disc.normal_in_world.unitOrthogonal();
  const Eigen::Vector3d v = disc.normal_in_world.cross(u);
  const double radius = settings.disc_radius_m * std::sqrt(random.uniform());
  const double angle = 2 * std::numbers::pi * random.uniform();
  const double off_plane = settings.point_sigma_m * random.normal();
  return disc.center_in_world + radius * (std::cos(angle) * u + std::sin(angle) * v) + off_plane * disc.normal_in_world;
}

std::size_t num_points_of(double density_per_m2) {
  return static_cast<std::size_t>(std::lround(density_per_m2 * std::numbers::pi));
}

double uniform(double low, double high, Random& random) { return low + (high - low) * random.uniform(); }

/// Of uniform polar angles, as the paper draws it: the poles are favored.
Eigen::Vector3d pole_heavy_direction(Random& random) {
  const double azimuth = uniform(0, 2 * std::numbers::pi, random);
  const double polar = uniform(0, std::numbers::pi, random);
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

/// In ±10 m, at least 3.2 m from the centers of `discs`. Ten such balls fill a sixth of the cube at most, so that a
/// place is found soon.
Eigen::Vector3d center_apart_from(std::span<const Disc> discs, Random& random) {
  constexpr double kHalfWidth_m = 10;
  constexpr double kLeastDistance_m = 3.2;
  for (;;) {
    Eigen::Vector3d center;
    for (double& coordinate : center) coordinate = uniform(-kHalfWidth_m, kHalfWidth_m, random);
    const bool is_apart = std::all_of(discs.begin(), discs.end(), [&](const Disc& disc) {
      return (disc.center_in_world - center).norm() >= kLeastDistance_m;
    });
    if (is_apart) return center;
  }
}

}  // namespace

void PlaneWorldSettings::validate() const {
  if (points_per_disc < 1) throw InvalidArgument("points_per_disc = 0 is out of range: it must be >= 1");
  if (!(disc_radius_m > 0 && std::isfinite(disc_radius_m))) {
    throw InvalidArgument("disc_radius_m = " + std::to_string(disc_radius_m) + " is out of range: it must be > 0");
  }
  if (!(point_sigma_m >= 0 && std::isfinite(point_sigma_m))) {
    throw InvalidArgument("point_sigma_m = " + std::to_string(point_sigma_m) + " is out of range: it must be >= 0");
  }
}

MemoryScans observe_discs(std::span<const Disc> discs, const Trajectory& true_poses,
                          const PlaneWorldSettings& settings) {
  settings.validate();
  require_discs(discs);
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < true_poses.size(); ++i) {
    Random random(settings.seed, i);
    const Pose scan_from_world = general_inverse(true_poses.world_from_scan[i]);
    Scan scan;
    for (const Disc& disc : discs) {
      const std::size_t num_points = disc.num_points.value_or(settings.points_per_disc);
      for (std::size_t k = 0; k < num_points; ++k) {
        scan.points_in_scan.push_back(scan_from_world * point_on_disc(disc, settings, random));
      }
    }
    scans.push_back(std::move(scan));
  }
  return MemoryScans(std::move(scans));
}

std::vector<Disc> orthogonal_discs(std::size_t num_per_direction, double spacing_m, std::uint64_t seed) {
  if (!(spacing_m > 0 && std::isfinite(spacing_m))) {
    throw InvalidArgument("spacing_m = " + std::to_string(spacing_m) + " is out of range: it must be > 0");
  }
  const std::size_t num_discs = 3 * num_per_direction;
  std::size_t side = 1;
  while (side * side * side < num_discs) ++side;
  std::vector<Eigen::Vector3d> cells;
  for (std::size_t k = 0; k < side * side * side; ++k) {
    const Eigen::Vector3d cell(static_cast<double>(k % side), static_cast<double>(k / side % side),
                               static_cast<double>(k / side / side));
    cells.push_back(spacing_m * cell);
  }
  Random random(seed);
  std::vector<Disc> discs;
  for (std::size_t k = 0; k < num_discs; ++k) {
    const auto rest = static_cast<double>(cells.size() - k);
    std::swap(cells[k], cells[k + static_cast<std::size_t>(rest * random.uniform())]);
    discs.push_back({cells[k], Eigen::Vector3d::Unit(static_cast<Eigen::Index>(k % 3))});
  }
  return discs;
}

std::vector<Disc> random_plane_world(std::uint64_t seed) {
  constexpr double kMostMore = 7;
  Random random(seed);
  const auto num_discs = 3 + static_cast<std::size_t>((kMostMore + 1) * random.uniform());
  std::vector<Disc> discs;
  while (discs.size() < num_discs) {
    const Eigen::Vector3d normal = discs.size() < 3 ? Eigen::Vector3d::Unit(static_cast<Eigen::Index>(discs.size()))
                                                    : pole_heavy_direction(random);
    const Eigen::Vector3d center = center_apart_from(discs, random);
    discs.push_back({center, normal.normalized(), num_points_of(uniform(30, 100, random))});
  }
  return discs;
}

std::string_view name_of(Counterexample counterexample) {
  switch (counterexample) {
    case Counterexample::kBalanced:
      return "balanced";
    case Counterexample::kUnbalanced:
      return "unbalanced";
    case Counterexample::kNonOrthogonal:
      break;
  }
  return "non-orthogonal";
}

std::vector<Disc> counterexample_discs(Counterexample counterexample) {
  constexpr double kRadiansPerDegree = std::numbers::pi / 180;
  constexpr double kDistance_m = 6;
  std::array<Eigen::Vector3d, 3> normals = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                            Eigen::Vector3d::UnitZ()};
  if (counterexample == Counterexample::kNonOrthogonal) {
    normals[1] = {std::cos(35 * kRadiansPerDegree), std::sin(35 * kRadiansPerDegree), 0};
    normals[2] = {std::cos(50 * kRadiansPerDegree), 0, std::sin(50 * kRadiansPerDegree)};
  }
  std::array<double, 3> densities_per_m2 = {60, 60, 60};
  if (counterexample == Counterexample::kUnbalanced) densities_per_m2 = {20, 60, 300};
  std::vector<Disc> discs;
  for (std::size_t k = 0; k < 3; ++k) {
    discs.push_back({kDistance_m * Eigen::Vector3d::Unit(static_cast<Eigen::Index>(k)), normals.at(k).normalized(),
                     num_points_of(densities_per_m2.at(k))});
  }
  return discs;
}

}  // namespace trysquare
