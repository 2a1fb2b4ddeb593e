// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/point_index.h"

#include "trysquare/core/error.h"
#include "trysquare/neighborhood/internal/kd_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace trysquare {
namespace {

void validate(PointsView points, std::span<const std::uint32_t> scan_of_point, std::size_t num_scans) {
  if (points.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidArgument(
        fmt::format("points_in_map has {} points: an index takes fewer than 2^32 - 1", points.size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) throw InvalidArgument(fmt::format("points_in_map[{}] is not finite", i));
  }
  if (scan_of_point.empty()) return;
  if (scan_of_point.size() != points.size()) {
    throw InvalidArgument(
        fmt::format("scan_of_point has {} entries for {} points", scan_of_point.size(), points.size()));
  }
  if (std::any_of(scan_of_point.begin(), scan_of_point.end(), [&](std::uint32_t scan) { return scan >= num_scans; })) {
    throw InvalidArgument(fmt::format("scan_of_point has an index that is not below num_scans = {}", num_scans));
  }
}

}  // namespace

PointIndex::PointIndex(PointsView points_in_map, std::span<const std::uint32_t> scan_of_point, std::size_t num_scans) {
  validate(points_in_map, scan_of_point, num_scans);
  tree_ = std::make_unique<Tree>(points_in_map, scan_of_point, num_scans);
}

PointIndex::PointIndex(const RegisteredMap& map) : PointIndex(map.points_in_map, map.scan_of_point, map.num_scans) {}

PointIndex::~PointIndex() = default;
PointIndex::PointIndex(PointIndex&&) noexcept = default;
PointIndex& PointIndex::operator=(PointIndex&&) noexcept = default;

PointsView PointIndex::points() const { return tree_->source.points; }
std::size_t PointIndex::num_scans() const { return tree_->num_scans; }

}  // namespace trysquare
