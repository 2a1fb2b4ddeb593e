// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/neighborhood/internal/moment_row.h"
#include "trysquare/neighborhood/internal/packed_points.h"
#include "trysquare/neighborhood/internal/packed_tree.h"
#include "trysquare/neighborhood/internal/vector_kernels.h"
#include "trysquare/neighborhood/moments.h"

#include <Eigen/Core>

#include <vector>

namespace trysquare {

/// Cuts the packed queries into runs that share a walk: the longer, the more queries share what is done once a leaf;
/// the narrower, the less of what is met is out of reach of most. The widths are measured, not derived.
std::vector<SuperGroup> super_groups(const PackedPoints& queries, double radius_m);

/// One pass about the super-group's center is as good as two about the mean, unless the neighborhood is small and far
/// from the center: then the squares cancel, and 1e-12 of λ₃ would be lost.
bool cancels(const MomentRow& sums, const Moments& moments);

/// @param sums  About a point from which the query is `query_from_center` away.
Moments moments_from(const MomentRow& sums, const Eigen::Vector3d& query_from_center);

/// Whether the vector kernels can be used: single precision holds the distances that decide.
bool fits_single_precision(double extent_m, double radius_m);

}  // namespace trysquare
