// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/plane_world.h"

#include "trysquare/core/error.h"
#include "trysquare/synthetic/random.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace trysquare {
namespace {

void require_unit_normals(std::span<const Disc> discs) {
  for (std::size_t i = 0; i < discs.size(); ++i) {
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
  require_unit_normals(discs);
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < true_poses.size(); ++i) {
    Random random(settings.seed, i);
    const Pose scan_from_world = general_inverse(true_poses.world_from_scan[i]);
    Scan scan;
    scan.points_in_scan.reserve(discs.size() * settings.points_per_disc);
    for (const Disc& disc : discs) {
      for (std::size_t k = 0; k < settings.points_per_disc; ++k) {
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

}  // namespace trysquare
