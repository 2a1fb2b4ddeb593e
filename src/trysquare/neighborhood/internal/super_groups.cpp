// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/internal/super_groups.h"

#include <cstdint>
#include <limits>

namespace trysquare {
namespace {

/// A box that grows query by query.
struct GrowingBox {
  Eigen::Vector3d lo = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d hi = -lo;

  GrowingBox with(const Eigen::Vector3d& point) const { return {lo.cwiseMin(point), hi.cwiseMax(point)}; }
  double diagonal() const { return (hi - lo).norm(); }
};

}  // namespace

std::vector<SuperGroup> super_groups(const PackedPoints& queries, double radius_m) {
  constexpr double kWidth = 4.0;
  constexpr double kWidthOfOneGroup = 10.0;
  std::vector<SuperGroup> groups;
  for (std::size_t first = 0; first < queries.num_points; first += groups.back().num_queries) {
    GrowingBox box = GrowingBox{}.with(queries.point(first));
    std::size_t count = 1;
    for (; first + count < queries.num_points && count < SuperGroup::kMaxQueries; ++count) {
      const GrowingBox grown = box.with(queries.point(first + count));
      const double width = count < SuperGroup::kGroupSize ? kWidthOfOneGroup : kWidth;
      if (grown.diagonal() > width * radius_m) break;
      box = grown;
    }
    groups.push_back({.first_query = first, .num_queries = count});
  }
  return groups;
}

bool cancels(const MomentRow& sums, const Moments& moments) {
  constexpr double kWorstRatio = 128;
  if (moments.count < 2) return false;
  const double about_center = (sums.sums[3] + sums.sums[6] + sums.sums[8]) / (sums.count() - 1);
  return !(about_center < kWorstRatio * moments.covariance.trace());
}

Moments moments_from(const MomentRow& sums, const Eigen::Vector3d& query_from_center) {
  const double n = sums.count();
  Moments moments{.count = static_cast<std::uint32_t>(n)};
  if (moments.count == 0) return moments;
  const double* s = sums.sums;
  const double x = s[0] / n;
  const double y = s[1] / n;
  const double z = s[2] / n;
  moments.mean_from_query = Eigen::Vector3d(x, y, z) - query_from_center;
  if (moments.count < 2) return moments;
  const double scale = 1 / (n - 1);
  const double xy = (s[4] - s[0] * y) * scale;
  const double xz = (s[5] - s[0] * z) * scale;
  const double yz = (s[7] - s[1] * z) * scale;
  moments.covariance << (s[3] - s[0] * x) * scale, xy, xz,  //
      xy, (s[6] - s[1] * y) * scale, yz,                    //
      xz, yz, (s[8] - s[2] * z) * scale;
  return moments;
}

bool fits_single_precision(double extent_m, double radius_m) {
  constexpr double kLargest = 1e15;
  constexpr double kSmallest = 1e-15;
  return radius_m > kSmallest && radius_m < kLargest && extent_m < kLargest;
}

}  // namespace trysquare
