// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/fixed_radius.h"

#include "trysquare/core/error.h"
#include "trysquare/neighborhood/internal/packed_tree.h"
#include "trysquare/neighborhood/internal/points_within.h"
#include "trysquare/neighborhood/internal/scalar_moments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace trysquare {
namespace {

void validate(std::string_view name, double length_m) {
  if (!(length_m > 0) || !std::isfinite(length_m)) {
    throw InvalidArgument(fmt::format("{} = {} is out of range: it must be positive and finite", name, length_m));
  }
}

struct PointOfScan {
  std::uint32_t scan;
  Eigen::Vector3d from_center;
};

/// The moments of points that are grouped by scan, in the order of the scans.
std::vector<ScanMoments> group(std::vector<PointOfScan> points) {
  std::stable_sort(points.begin(), points.end(),
                   [](const PointOfScan& a, const PointOfScan& b) { return a.scan < b.scan; });
  std::vector<ScanMoments> result;
  std::vector<Eigen::Vector3d> of_scan;
  for (std::size_t i = 0; i < points.size(); ++i) {
    of_scan.push_back(points[i].from_center);
    if (i + 1 < points.size() && points[i + 1].scan == points[i].scan) continue;
    result.push_back({.scan = points[i].scan, .moments = moments_in_two_passes(of_scan)});
    result.back().moments.num_scans = 1;
    of_scan.clear();
  }
  return result;
}

/// The points of a ball for which keep(point − center) is true.
template <class Keep>
std::vector<ScanMoments> moments_of(const PointIndex::Tree& tree, const Eigen::Vector3d& center, double radius_m,
                                    const Keep& keep) {
  if (!center.allFinite()) throw InvalidArgument("center_in_map is not finite");
  std::vector<PointOfScan> points;
  for_each_point_within(tree, center, radius_m, [&](std::size_t i) {
    const Eigen::Vector3d from_center = tree.packed.point(i) - center;
    if (keep(from_center)) points.push_back({tree.has_scans() ? tree.scans[i] : 0, from_center});
  });
  return group(std::move(points));
}

}  // namespace

std::vector<ScanMoments> moments_by_scan(const PointIndex& map, const Ball& region) {
  validate("radius_m", region.radius_m);
  return moments_of(map.tree(), region.center_in_map, region.radius_m, [](const Eigen::Vector3d&) { return true; });
}

std::vector<ScanMoments> moments_by_scan(const PointIndex& map, const Cylinder& region) {
  validate("radius_m", region.radius_m);
  validate("half_height_m", region.half_height_m);
  if (!(std::abs(region.axis.norm() - 1) < 1e-6)) {
    throw InvalidArgument(fmt::format("axis has the length {}, expected 1", region.axis.norm()));
  }
  constexpr double kRoundingMargin = 1 + 1e-9;  // the corner of the cylinder belongs to it
  const double reach_m = kRoundingMargin * std::hypot(region.radius_m, region.half_height_m);
  return moments_of(map.tree(), region.center_in_map, reach_m, [&](const Eigen::Vector3d& from_center) {
    const double along = from_center.dot(region.axis);
    return std::abs(along) <= region.half_height_m &&
           (from_center - along * region.axis).squaredNorm() < region.radius_m * region.radius_m;
  });
}

}  // namespace trysquare
