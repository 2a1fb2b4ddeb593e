// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/measured_points.h"

#include <utility>

namespace trysquare {
namespace {

Scan scan_of(std::vector<Eigen::Vector3d> points, bool keep_origin) {
  Scan scan;
  scan.points_in_scan = std::move(points);
  std::erase_if(scan.points_in_scan, [&](const Eigen::Vector3d& point) {
    const bool finite = point.allFinite();
    const bool at_origin = finite && point.isZero(0.0);
    scan.num_not_finite += finite ? 0 : 1;
    scan.num_at_origin += at_origin ? 1 : 0;
    return !finite || (at_origin && !keep_origin);
  });
  return scan;
}

}  // namespace

Scan scan_of_measured(std::vector<Eigen::Vector3d> points) { return scan_of(std::move(points), false); }

Scan map_of_measured(std::vector<Eigen::Vector3d> points) { return scan_of(std::move(points), true); }

}  // namespace trysquare
