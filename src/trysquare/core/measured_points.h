// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/scan.h"

#include <Eigen/Core>

#include <vector>

namespace trysquare {

/// A scan of points as a sensor or a file has them. Points that are not finite are dropped and counted; points exactly
/// at (0, 0, 0), which are invalid returns, likewise (docs/definitions.md#dropped-points).
Scan scan_of_measured(std::vector<Eigen::Vector3d> points);

/// A registered map, where (0, 0, 0) is a place like any other: points at the origin are counted but kept.
Scan map_of_measured(std::vector<Eigen::Vector3d> points);

}  // namespace trysquare
