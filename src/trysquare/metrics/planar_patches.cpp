// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/planar_patches.h"

#include "trysquare/core/error.h"
#include "trysquare/metrics/internal/canonical_sign.h"
#include "trysquare/metrics/internal/one_per_voxel.h"
#include "trysquare/metrics/internal/scans_of_map.h"
#include "trysquare/neighborhood/for_each_neighborhood.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace trysquare {
namespace {

void require(bool in_range, const char* name, double value, const char* range) {
  if (!in_range)
    throw InvalidArgument(fmt::format("planar patches: {} = {} is out of range: it must be {}", name, value, range));
}

bool is_positive(double value) { return value > 0 && value < std::numeric_limits<double>::infinity(); }

bool is_planar(const PlanarPatch& patch, double radius_m, const PlanarPatchSettings& settings) {
  const Eigen::Vector3d& lambda = patch.eigenvalues;
  const bool is_flat = settings.planarity_ratio * lambda[0] < lambda[1];
  const bool is_line = lambda[1] <= settings.line_ratio * lambda[2];
  const bool is_thin = std::sqrt(lambda[0]) < settings.max_thickness * radius_m;
  return patch.num_points >= settings.min_points && is_flat && !is_line && is_thin;
}

PlanarPatch patch_of(const Eigen::Vector3d& center, const Moments& moments, std::uint32_t scan) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments.covariance);
  return {.center_in_map = center,
          .normal_in_map = with_canonical_sign(solver.eigenvectors().col(0).normalized()),
          .eigenvalues = solver.eigenvalues().cwiseMax(0),
          .scan = scan,
          .num_points = moments.count};
}

/// The candidates of one scan, planar or not.
std::vector<PlanarPatch> candidates_of_scan(const RegisteredMap& map, std::uint32_t scan, double radius_m,
                                            const PlanarPatchSettings& settings, const Execution& execution) {
  // Sorted: the sums over a neighborhood then do not depend on the order in which the points came.
  const std::vector<Eigen::Vector3d> points = one_per_voxel(points_of_scan(map, scan), 0);
  const std::vector<Eigen::Vector3d> centers = one_per_voxel(points, settings.spacing * radius_m);
  std::vector<PlanarPatch> candidates(centers.size());
  const NeighborhoodSettings ball{.radius_m = settings.patch_radius * radius_m};
  for_each_neighborhood(PointIndex(points, execution), centers, ball, execution, [&](const NeighborhoodBlock& block) {
    for (std::size_t i = 0; i < block.moments.size(); ++i) {
      const std::uint32_t candidate = block.queries[i];
      candidates[candidate] = patch_of(centers[candidate], block.moments[i], scan);
    }
  });
  return candidates;
}

/// One patch per voxel, the flattest; ties by coordinates, then by scan.
std::vector<PlanarPatch> flattest_per_voxel(const std::vector<PlanarPatch>& patches, double voxel_m) {
  struct Candidate {
    std::array<double, 3> voxel;
    const PlanarPatch* patch;

    auto key() const {
      const Eigen::Vector3d& center = patch->center_in_map;
      const double flatness = patch->eigenvalues[0] / patch->eigenvalues[1];
      return std::tuple(voxel, flatness, center.x(), center.y(), center.z(), patch->scan);
    }
  };
  std::vector<Candidate> candidates;
  for (const PlanarPatch& patch : patches) {
    const Eigen::Vector3d voxel = (patch.center_in_map / voxel_m).array().floor();
    candidates.push_back({{voxel.x(), voxel.y(), voxel.z()}, &patch});
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.key() < b.key(); });
  std::vector<PlanarPatch> kept;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i == 0 || candidates[i].voxel != candidates[i - 1].voxel) kept.push_back(*candidates[i].patch);
  }
  return kept;
}

}  // namespace

void PlanarPatchSettings::validate() const {
  require(num_scans >= 1, "num_scans", static_cast<double>(num_scans), "at least 1");
  require(is_positive(patch_radius), "patch_radius", patch_radius, "positive and finite");
  require(is_positive(spacing), "spacing", spacing, "positive and finite");
  require(is_positive(planarity_ratio), "planarity_ratio", planarity_ratio, "positive and finite");
  require(line_ratio >= 0 && line_ratio < 1, "line_ratio", line_ratio, "in [0, 1)");
  require(is_positive(max_thickness), "max_thickness", max_thickness, "positive and finite");
  require(min_points >= 4, "min_points", static_cast<double>(min_points), "at least 4");
}

PlanarPatches planar_patches(const RegisteredMap& map, double radius_m, const PlanarPatchSettings& settings,
                             const Execution& execution) {
  settings.validate();
  execution.validate();
  require(is_positive(radius_m), "radius_m", radius_m, "positive and finite");
  require_points_of_scans(map);
  PlanarPatches result;
  std::vector<PlanarPatch> planar;
  for (const std::uint32_t scan : evenly_spread_scans(map.num_scans, settings.num_scans)) {
    const std::vector<PlanarPatch> candidates = candidates_of_scan(map, scan, radius_m, settings, execution);
    result.num_candidates += candidates.size();
    std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(planar),
                 [&](const PlanarPatch& patch) { return is_planar(patch, radius_m, settings); });
  }
  result.num_planar = planar.size();
  result.patches = flattest_per_voxel(planar, settings.spacing * radius_m);
  return result;
}

}  // namespace trysquare
