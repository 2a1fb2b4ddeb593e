// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/patch_observations.h"

#include "trysquare/neighborhood/fixed_radius.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace trysquare {
namespace {

constexpr std::uint32_t kFewestPoints = 6;     ///< Of a scan on a patch.
constexpr double kFewestDegreesOfFreedom = 5;  ///< Of a patch, for its noise.
constexpr double kNoiseFloor_m = 0.001;        ///< Surfaces are not flatter than that.

/// Two axes in the plane of the patch and its normal, as rows.
Eigen::Matrix3d frame_of(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d axis = std::abs(normal.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  Eigen::Matrix3d frame;
  frame.row(0) = normal.cross(axis).normalized();
  frame.row(1) = normal.cross(frame.row(0).transpose());
  frame.row(2) = normal;
  return frame;
}

/// The points of one scan on one patch, in the frame (u, v, w) of the patch.
struct PatchMoments {
  std::uint32_t patch = 0;
  double count = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();     ///< From the center [m].
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();  ///< Sum of squared deviations from the mean [m²].
};

/// The scans that can see the front of a patch and are near enough. The front is where the patch was found from; poses
/// are trusted to `half_height_m`.
std::vector<std::uint32_t> scans_before(const ObservedPatch& patch, const Eigen::Vector3d& found_from,
                                        std::span<const Pose> map_from_scan, double half_height_m, double range_m) {
  const bool is_front_ahead = patch.normal_in_map.dot(found_from - patch.center_in_map) >= 0;
  const Eigen::Vector3d front = is_front_ahead ? patch.normal_in_map : Eigen::Vector3d(-patch.normal_in_map);
  std::vector<std::uint32_t> result;
  for (std::size_t scan = 0; scan < map_from_scan.size(); ++scan) {
    const Eigen::Vector3d from_center = map_from_scan[scan].translation - patch.center_in_map;
    if (from_center.norm() <= range_m && front.dot(from_center) >= -half_height_m) {
      result.push_back(static_cast<std::uint32_t>(scan));
    }
  }
  return result;
}

/// The scans that look at a patch, thinned out evenly when there are many. The phase of the thinning differs from patch
/// to patch, so that every two scans share some patches.
std::vector<std::uint32_t> thinned_out(const std::vector<std::uint32_t>& near, std::size_t patch, std::size_t count) {
  if (near.size() <= count) return near;
  std::vector<std::uint32_t> kept;
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double step = static_cast<double>(near.size()) / static_cast<double>(count);
  double phase = static_cast<double>(patch + 1) * kGoldenRatio;
  for (std::size_t i = 0; i < count; ++i) {
    phase += kGoldenRatio * kGoldenRatio;
    phase -= std::floor(phase);
    kept.push_back(near[static_cast<std::size_t>((static_cast<double>(i) + phase) * step)]);
  }
  return kept;
}

/// For every scan the patches that it looks at.
std::vector<std::vector<std::uint32_t>> patches_of_scans(std::span<const PlanePatch> patches,
                                                         const std::vector<ObservedPatch>& in_map,
                                                         std::span<const Pose> map_from_scan, double half_height_m,
                                                         const AdjustmentSettings& settings) {
  std::vector<std::vector<std::uint32_t>> patches_of_scan(map_from_scan.size());
  for (std::size_t patch = 0; patch < patches.size(); ++patch) {
    const std::vector<std::uint32_t> near =
        scans_before(in_map[patch], map_from_scan[patches[patch].scan].translation, map_from_scan, half_height_m,
                     settings.max_observation_range_m);
    for (const std::uint32_t scan : thinned_out(near, patch, settings.max_observers)) {
      patches_of_scan[scan].push_back(static_cast<std::uint32_t>(patch));
    }
  }
  return patches_of_scan;
}

std::vector<PatchMoments> moments_of_scan(const PointIndex& scan, const Pose& map_from_scan,
                                          const std::vector<ObservedPatch>& patches,
                                          const std::vector<std::uint32_t>& looked_at, double half_height_m,
                                          double patch_radius_m) {
  const Pose scan_from_map = general_inverse(map_from_scan);
  std::vector<PatchMoments> result;
  for (const std::uint32_t patch : looked_at) {
    const Eigen::Matrix3d scan_frame = frame_of(patches[patch].normal_in_map) * map_from_scan.rotation;
    const std::vector<ScanMoments> found =
        moments_by_scan(scan, Cylinder{.center_in_map = scan_from_map * patches[patch].center_in_map,
                                       .axis = scan_frame.row(2).transpose().normalized(),
                                       .radius_m = patch_radius_m,
                                       .half_height_m = half_height_m});
    if (found.empty() || found[0].moments.count < kFewestPoints) continue;
    const Moments& moments = found[0].moments;
    result.push_back({.patch = patch,
                      .count = static_cast<double>(moments.count),
                      .mean = scan_frame * moments.mean_from_query,
                      .scatter = (moments.count - 1.0) * scan_frame * moments.covariance * scan_frame.transpose()});
  }
  return result;
}

struct MomentsOfScan {
  std::uint32_t scan = 0;
  const PatchMoments* moments = nullptr;
};

/// Analysis of covariance: w = intercept of the scan + slope · (u, v) + noise, one slope for all scans.
void fit_intercepts(const std::vector<MomentsOfScan>& seen_by, ObservedPatch& patch) {
  if (seen_by.size() < 2) return;
  Eigen::Matrix3d pooled = Eigen::Matrix3d::Zero();
  double degrees_of_freedom = -2;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // of the scans' means: where the slope moves nothing
  for (const MomentsOfScan& seen : seen_by) {
    pooled += seen.moments->scatter;
    degrees_of_freedom += seen.moments->count - 1;
    center += seen.moments->mean.head<2>() / static_cast<double>(seen_by.size());
  }
  const Eigen::Matrix2d in_plane = pooled.topLeftCorner<2, 2>();
  const double largest = in_plane.diagonal().maxCoeff();
  const bool is_determined = in_plane.determinant() > 1e-4 * largest * largest + 1e-12;
  if (!is_determined || degrees_of_freedom < kFewestDegreesOfFreedom) return;
  const Eigen::Matrix2d inverse = in_plane.inverse();
  const Eigen::Vector2d slope = inverse * pooled.topRightCorner<2, 1>();
  const double residual = pooled(2, 2) - slope.dot(pooled.topRightCorner<2, 1>());
  const double noise_m2 = std::max(residual, 0.0) / degrees_of_freedom;
  patch.within_scan_sigma_m = std::sqrt(noise_m2);
  for (const MomentsOfScan& seen : seen_by) {
    const Eigen::Vector2d mean = seen.moments->mean.head<2>();
    const Eigen::Vector2d lever = mean - center;
    patch.observations.push_back({.scan = seen.scan,
                                  .intercept_m = seen.moments->mean.z() - slope.dot(mean),
                                  .variance_m2 = (noise_m2 + kNoiseFloor_m * kNoiseFloor_m) *
                                                 (1 / seen.moments->count + lever.dot(inverse * lever))});
  }
}

}  // namespace

std::vector<ObservedPatch> observe_patches(std::span<const PlanePatch> patches, const IndexedScans& scans,
                                           std::span<const Pose> map_from_scan, double half_height_m,
                                           const AdjustmentSettings& settings, const Execution& execution) {
  std::vector<ObservedPatch> result(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Pose& pose = map_from_scan[patches[i].scan];
    result[i].center_in_map = pose * patches[i].center_in_scan;
    result[i].normal_in_map = (pose.rotation * patches[i].normal_in_scan).normalized();
  }
  const std::vector<std::vector<std::uint32_t>> looked_at =
      patches_of_scans(patches, result, map_from_scan, half_height_m, settings);
  std::vector<std::vector<PatchMoments>> of_scan(scans.size());
  scans.for_each(execution, "observations", [&](std::size_t scan, const IndexedScans::IndexedScan& indexed) {
    of_scan[scan] = moments_of_scan(*indexed.index, map_from_scan[scan], result, looked_at[scan], half_height_m,
                                    settings.patch_radius_m);
  });
  std::vector<std::vector<MomentsOfScan>> of_patch(patches.size());
  for (std::size_t scan = 0; scan < of_scan.size(); ++scan) {
    for (const PatchMoments& moments : of_scan[scan]) {
      of_patch[moments.patch].push_back({static_cast<std::uint32_t>(scan), &moments});
    }
  }
  for (std::size_t i = 0; i < patches.size(); ++i) fit_intercepts(of_patch[i], result[i]);
  return result;
}

}  // namespace trysquare
