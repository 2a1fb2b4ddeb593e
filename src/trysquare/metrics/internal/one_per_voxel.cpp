// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/internal/one_per_voxel.h"

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

}  // namespace trysquare
