// SPDX-License-Identifier: Apache-2.0
#include "trysquare/mapping/exact_duplicates.h"

#include <algorithm>
#include <vector>

namespace trysquare {
namespace {

bool comes_before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

}  // namespace

std::size_t count_exact_duplicates(PointsView points) {
  std::vector<Eigen::Vector3d> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(), comes_before);
  const auto unique_end = std::unique(sorted.begin(), sorted.end());
  return static_cast<std::size_t>(sorted.end() - unique_end);
}

}  // namespace trysquare
