// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/patch_subset.h"

#include "trysquare/core/error.h"
#include "trysquare/metrics/internal/one_per_voxel.h"
#include "trysquare/metrics/internal/scans_of_map.h"
#include "trysquare/neighborhood/for_each_neighborhood.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

namespace trysquare {
namespace {

std::string why_incomplete(const PatchSubsetResult& result) {
  if (result.num_patches == 0) return fmt::format("none of {} points lies on a planar patch", result.num_candidates);
  if (result.directions.empty())
    return fmt::format("no direction stands out among the normals of {} planar patches", result.num_patches);
  return fmt::format("only {} of 3 mutually orthogonal directions found in {} planar patches", result.directions.size(),
                     result.num_patches);
}

/// A patch that faces a direction, and how flat its scan is around it, as far as the metrics look.
struct FacingPatch {
  std::size_t patch = 0;
  double flatness = std::numeric_limits<double>::infinity();  ///< λ₁ / λ₂; infinity where the surface faces elsewhere.
};

/// Fills in the flatness of the patches of one scan.
void measure_flatness(const RegisteredMap& map, std::uint32_t scan, const std::vector<PlanarPatch>& patches,
                      const OrthogonalTriad& triad, const OrthogonalTriadSettings& settings, double radius_m,
                      const Execution& execution, std::vector<FacingPatch>& facing) {
  std::vector<Eigen::Vector3d> centers;
  std::vector<std::size_t> of_scan;  // indices into `facing`
  for (std::size_t i = 0; i < facing.size(); ++i) {
    if (patches[facing[i].patch].scan != scan) continue;
    centers.push_back(patches[facing[i].patch].center_in_map);
    of_scan.push_back(i);
  }
  if (centers.empty()) return;
  const std::vector<Eigen::Vector3d> points = one_per_voxel(points_of_scan(map, scan), 0);
  for_each_neighborhood(
      PointIndex(points, execution), centers, {.radius_m = radius_m}, execution, [&](const NeighborhoodBlock& block) {
        for (std::size_t i = 0; i < block.moments.size(); ++i) {
          FacingPatch& of_query = facing[of_scan[block.queries[i]]];
          const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(block.moments[i].covariance);
          const Eigen::Vector3d& axis = triad.directions[triad.direction_of_normal[of_query.patch]].axis;
          const double cosine = std::abs(solver.eigenvectors().col(0).dot(axis));
          if (cosine < std::cos(settings.tolerance_rad) || !(solver.eigenvalues()[1] > 0)) continue;
          of_query.flatness = std::max(solver.eigenvalues()[0], 0.0) / solver.eigenvalues()[1];
        }
      });
}

/// The flat ones, or the flattest when there are too few, in the order of the patches.
std::vector<Eigen::Vector3d> flattest(std::vector<FacingPatch> facing, const std::vector<PlanarPatch>& patches,
                                      const PatchSubsetSettings& settings) {
  std::sort(facing.begin(), facing.end(), [](const FacingPatch& a, const FacingPatch& b) {
    return std::tuple(a.flatness, a.patch) < std::tuple(b.flatness, b.patch);
  });
  const auto is_flat = [&](const FacingPatch& patch) { return settings.planarity_ratio * patch.flatness < 1; };
  const auto end = std::partition_point(facing.begin(), facing.end(), is_flat);
  const auto num_flat = static_cast<std::size_t>(end - facing.begin());
  facing.resize(std::min(facing.size(), std::max(num_flat, settings.min_points)));
  std::sort(facing.begin(), facing.end(), [](const FacingPatch& a, const FacingPatch& b) { return a.patch < b.patch; });
  std::vector<Eigen::Vector3d> points;
  for (const FacingPatch& patch : facing) points.push_back(patches[patch.patch].center_in_map);
  return points;
}

OrthogonalSubset subset_of(const RegisteredMap& map, const std::vector<PlanarPatch>& patches,
                           const OrthogonalTriad& triad, double radius_m, const PatchSubsetSettings& settings,
                           const Execution& execution) {
  std::vector<FacingPatch> facing;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (triad.direction_of_normal[i] != kNoDirection) facing.push_back({.patch = i});
  }
  for (const std::uint32_t scan : evenly_spread_scans(map.num_scans, settings.patches.num_scans)) {
    measure_flatness(map, scan, patches, triad, settings.triad, radius_m, execution, facing);
  }
  OrthogonalSubset subset;
  for (std::size_t k = 0; k < triad.directions.size(); ++k) {
    std::vector<FacingPatch> of_direction;
    std::copy_if(facing.begin(), facing.end(), std::back_inserter(of_direction),
                 [&](const FacingPatch& patch) { return triad.direction_of_normal[patch.patch] == k; });
    subset.directions.push_back({.normal_in_map = triad.directions[k].axis,
                                 .points_in_map = flattest(std::move(of_direction), patches, settings)});
  }
  return subset;
}

}  // namespace

void PatchSubsetSettings::validate() const {
  patches.validate();
  triad.validate();
  if (!(planarity_ratio > 0) || !std::isfinite(planarity_ratio)) {
    throw InvalidArgument(fmt::format(
        "patch subset: planarity_ratio = {} is out of range: it must be positive and finite", planarity_ratio));
  }
  if (min_points < 1) throw InvalidArgument("patch subset: min_points = 0 is out of range: it must be at least 1");
}

std::optional<double> PatchSubsetResult::planar_share() const {
  if (num_candidates == 0) return std::nullopt;
  return static_cast<double>(num_planar) / static_cast<double>(num_candidates);
}

PatchSubsetResult patch_subset(const RegisteredMap& map, double radius_m, const PatchSubsetSettings& settings,
                               const Execution& execution) {
  settings.validate();
  const PlanarPatches found = planar_patches(map, radius_m, settings.patches, execution);  // step 1: planar patches
  std::vector<Eigen::Vector3d> normals;
  for (const PlanarPatch& patch : found.patches) normals.push_back(patch.normal_in_map);
  OrthogonalTriad triad = orthogonal_triad(normals, settings.triad);  // step 2: directions that their normals share
  PatchSubsetResult result{.subset = subset_of(map, found.patches, triad, radius_m, settings,
                                               execution),  // step 3: the patches that face them
                           .directions = std::move(triad.directions),
                           .chance = triad.chance,
                           .num_candidates = found.num_candidates,
                           .num_planar = found.num_planar,
                           .num_patches = found.patches.size(),
                           .num_modes = triad.num_modes};
  if (result.directions.size() < 3) result.reason = why_incomplete(result);
  return result;
}

}  // namespace trysquare
