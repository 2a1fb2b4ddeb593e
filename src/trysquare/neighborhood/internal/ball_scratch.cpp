// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/internal/vector_kernels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trysquare {
namespace {

/// How far single precision can be off near the surface of a ball, twice over.
///
/// A coordinate about the center is at most `reach` = half the box of the queries plus the radius where it matters, so
/// rounding it, and a query, and their difference moves a component by at most `step`; the squared distance then moves
/// by 2√3·r·step + 3·step², and its own arithmetic rounds 4 times.
GuardBand guard_band(double radius_m, double half_box_m, double largest_coordinate_m) {
  constexpr double kUlp = 0x1p-24;
  const double step = kUlp * 2 * (half_box_m + radius_m) + 0x1p-50 * largest_coordinate_m;
  const double squared = radius_m * radius_m;
  const double band = 2 * (2 * std::sqrt(3.0) * radius_m * step + 3 * step * step + 4 * kUlp * squared);
  return {static_cast<float>(squared - band), static_cast<float>(squared + band)};
}

}  // namespace

void start_super_group(const PointIndex::Tree& map, const PackedPoints& queries, double radius_m,
                       const SuperGroup& super_group, BallScratch& scratch) {
  constexpr std::size_t kGroup = SuperGroup::kGroupSize;
  const std::size_t padded = super_group.num_groups() * kGroup;
  double half_box_m = 0;
  scratch.center = center_of(queries, super_group);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Boxes of the groups, about the origin and rounded outwards.
    const double origin = map.packed.origin[static_cast<Eigen::Index>(axis)];
    const auto coordinate = [&](std::size_t i) {
      const std::size_t query = super_group.first_query + std::min(i, super_group.num_queries - 1);
      return queries.leaf_axis(query / kGroup, axis)[query % kGroup];
    };
    scratch.lo[axis] = std::numeric_limits<float>::infinity();
    scratch.hi[axis] = -std::numeric_limits<float>::infinity();
    for (std::size_t group = 0; group < super_group.num_groups(); ++group) {
      double lowest = coordinate(group * kGroup);
      double highest = lowest;
      for (std::size_t i = 1; i < kGroup; ++i) {
        lowest = std::min(lowest, coordinate(group * kGroup + i));
        highest = std::max(highest, coordinate(group * kGroup + i));
      }
      scratch.group_lo[axis][group] = rounded_down(lowest - origin);
      scratch.group_hi[axis][group] = rounded_up(highest - origin);
      scratch.lo[axis] = std::min(scratch.lo[axis], scratch.group_lo[axis][group]);
      scratch.hi[axis] = std::max(scratch.hi[axis], scratch.group_hi[axis][group]);
    }
    for (std::size_t group = super_group.num_groups(); group % 16 != 0; ++group) {
      scratch.group_lo[axis][group] = std::numeric_limits<float>::infinity();
      scratch.group_hi[axis][group] = std::numeric_limits<float>::infinity();
    }
    const double center = scratch.center[static_cast<Eigen::Index>(axis)];
    scratch.center_from_origin[axis] = static_cast<float>(center - origin);
    const double middle = scratch.center_from_origin[axis];
    half_box_m = std::max({half_box_m, scratch.hi[axis] - middle, middle - scratch.lo[axis]});
    for (std::size_t i = 0; i < padded; ++i) scratch.queries[axis][i] = static_cast<float>(coordinate(i) - center);
  }
  scratch.squared_radius = guard_band(radius_m, half_box_m, scratch.center.cwiseAbs().maxCoeff());
  scratch.sums_of_all = {};
  std::fill_n(scratch.sums_of_group.begin(), super_group.num_groups(), MomentRow{});
  std::fill_n(scratch.query_sums.begin(), padded, BallScratch::PaddedRow{});
  if (map.has_scans()) scratch.scans.start(padded);
}

Eigen::Vector3d center_of(const PackedPoints& queries, const SuperGroup& super_group) {
  Eigen::Vector3d lo = queries.point(super_group.first_query);
  Eigen::Vector3d hi = lo;
  for (std::size_t i = 1; i < super_group.num_queries; ++i) {
    lo = lo.cwiseMin(queries.point(super_group.first_query + i));
    hi = hi.cwiseMax(queries.point(super_group.first_query + i));
  }
  return queries.origin + ((lo + hi) / 2 - queries.origin).cast<float>().cast<double>();
}

MomentRow sums_of_query(const BallScratch& scratch, std::size_t query) {
  MomentRow sums = scratch.sums_of_all;
  sums.add(scratch.sums_of_group[query / SuperGroup::kGroupSize]);
  for (std::size_t i = 0; i < MomentRow::kSize; ++i) sums.sums[i] += scratch.query_sums[query][i];
  return sums;
}

}  // namespace trysquare
