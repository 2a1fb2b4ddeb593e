// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/plane_patches.h"

#include "trysquare/metrics/planar_patches.h"

#include <algorithm>
#include <cstddef>

namespace trysquare {
namespace {

constexpr std::size_t kFewestSources = 5;

/// Scans 0 to num_scans − 1 that offer patches, evenly spread, first and last among them.
std::vector<bool> source_scans(std::size_t num_scans, std::size_t scans_per_source) {
  const std::size_t num_sources =
      std::min(num_scans, std::max(kFewestSources, (num_scans + scans_per_source - 1) / scans_per_source));
  std::vector<bool> is_source(num_scans, false);
  for (std::size_t i = 0; i < num_sources; ++i) {
    is_source[num_sources == 1 ? 0 : i * (num_scans - 1) / (num_sources - 1)] = true;
  }
  return is_source;
}

std::vector<PlanePatch> patches_of_scan(std::size_t scan, const IndexedScans::IndexedScan& indexed,
                                        const AdjustmentSettings& settings) {
  RegisteredMap one_scan{.num_scans = 1};
  for (const Eigen::Vector3d& point : indexed.points_in_scan) {
    const double range_m = point.norm();
    if (range_m >= settings.min_patch_range_m && range_m <= settings.max_patch_range_m) {
      one_scan.points_in_map.push_back(point);
    }
  }
  one_scan.scan_of_point.assign(one_scan.points_in_map.size(), 0);
  const PlanarPatchSettings planar{.num_scans = 1,
                                   .patch_radius = settings.patch_radius_m / settings.patch_spacing_m,
                                   .spacing = 1,
                                   .planarity_ratio = settings.planarity_ratio,
                                   .max_thickness = settings.max_thickness_m / settings.patch_spacing_m};
  std::vector<PlanePatch> result;
  for (const PlanarPatch& found :
       planar_patches(one_scan, settings.patch_spacing_m, planar, {.num_threads = 1}).patches) {
    result.push_back({.scan = static_cast<std::uint32_t>(scan),
                      .center_in_scan = found.center_in_map,
                      .normal_in_scan = found.normal_in_map});
  }
  return result;
}

/// `count` of the patches, evenly spread over their order: that of the scans, and of the voxels within a scan.
std::vector<PlanePatch> thinned_out(const std::vector<PlanePatch>& patches, std::size_t count) {
  if (patches.size() <= count) return patches;
  std::vector<PlanePatch> kept;
  for (std::size_t i = 0; i < count; ++i) kept.push_back(patches[i * patches.size() / count]);
  return kept;
}

}  // namespace

std::vector<PlanePatch> find_plane_patches(const IndexedScans& scans, const AdjustmentSettings& settings,
                                           const Execution& execution) {
  const std::vector<bool> is_source = source_scans(scans.size(), settings.scans_per_source);
  std::vector<std::vector<PlanePatch>> of_scan(scans.size());
  scans.for_each(execution, "patches", [&](std::size_t scan, const IndexedScans::IndexedScan& indexed) {
    if (is_source[scan]) of_scan[scan] = patches_of_scan(scan, indexed, settings);
  });
  std::vector<PlanePatch> patches;
  for (const std::vector<PlanePatch>& of_one : of_scan) patches.insert(patches.end(), of_one.begin(), of_one.end());
  const auto num_sources = static_cast<std::size_t>(std::count(is_source.begin(), is_source.end(), true));
  return thinned_out(patches, num_sources * settings.max_patches_per_source);
}

}  // namespace trysquare
