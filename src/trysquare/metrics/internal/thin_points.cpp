// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/internal/thin_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace trysquare {
namespace {

/// A point with its voxel; ordered by voxel, then by distance to the voxel's center, then by coordinates.
struct Candidate {
  std::array<double, 3> voxel;
  double squared_distance_to_center;
  Eigen::Vector3d point;

  auto key() const { return std::tuple(voxel, squared_distance_to_center, point.x(), point.y(), point.z()); }
};

}  // namespace

std::vector<Eigen::Vector3d> one_per_voxel(PointsView points, double voxel_m) {
  std::vector<Candidate> candidates;
  candidates.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    if (voxel_m == 0) {
      candidates.push_back({{point.x(), point.y(), point.z()}, 0, point});
      continue;
    }
    const Eigen::Vector3d voxel = (point / voxel_m).array().floor();
    const Eigen::Vector3d center = (voxel.array() + 0.5) * voxel_m;
    candidates.push_back({{voxel.x(), voxel.y(), voxel.z()}, (point - center).squaredNorm(), point});
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.key() < b.key(); });
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (voxel_m == 0 || i == 0 || candidates[i].voxel != candidates[i - 1].voxel) kept.push_back(candidates[i].point);
  }
  return kept;
}

std::vector<Eigen::Vector3d> thin_points(PointsView points, double smallest_voxel_m, std::size_t max_points) {
  if (points.size() <= max_points) return one_per_voxel(points, 0);
  double largest_coordinate_m = 0;
  for (const Eigen::Vector3d& point : points) {
    largest_coordinate_m = std::max(largest_coordinate_m, point.cwiseAbs().maxCoeff());
  }
  std::vector<Eigen::Vector3d> kept;
  for (double voxel_m = smallest_voxel_m;; voxel_m *= 1.25) {
    kept = one_per_voxel(points, voxel_m);
    if (kept.size() <= max_points || voxel_m > largest_coordinate_m) break;  // eight voxels meet at the origin
  }
  kept.resize(std::min(kept.size(), max_points));
  return kept;
}

}  // namespace trysquare
