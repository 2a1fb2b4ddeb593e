// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/point_index.h"

#include "trysquare/core/error.h"
#include "trysquare/neighborhood/internal/packed_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace trysquare {

void validate_points(std::string_view name, PointsView points) {
  constexpr double kLargest = 1e150;  // squares of it are finite
  if (points.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidArgument(fmt::format("{} has {} points: an index takes fewer than 2^32 - 1", name, points.size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) throw InvalidArgument(fmt::format("{}[{}] is not finite", name, i));
    if (points[i].cwiseAbs().maxCoeff() > kLargest) {
      throw InvalidArgument(fmt::format("{}[{}] is out of range: {:g} m is the limit", name, i, kLargest));
    }
  }
}

namespace {

void validate(PointsView points, std::span<const std::uint32_t> scan_of_point, std::size_t num_scans) {
  validate_points("points_in_map", points);
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

PointIndex::PointIndex(PointsView points_in_map, std::span<const std::uint32_t> scan_of_point, std::size_t num_scans,
                       const Execution& execution) {
  validate(points_in_map, scan_of_point, num_scans);
  tree_ = std::make_unique<Tree>(points_in_map, scan_of_point, num_scans, execution);
}

PointIndex::PointIndex(const RegisteredMap& map, const Execution& execution)
    : PointIndex(map.points_in_map, map.scan_of_point, map.num_scans, execution) {}

PointIndex::~PointIndex() = default;
PointIndex::PointIndex(PointIndex&&) noexcept = default;
PointIndex& PointIndex::operator=(PointIndex&&) noexcept = default;

PointsView PointIndex::points() const { return tree_->source; }
std::size_t PointIndex::num_scans() const { return tree_->num_scans; }

}  // namespace trysquare
