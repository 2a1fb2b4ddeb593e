// SPDX-License-Identifier: Apache-2.0
#include "neighborhood_values.h"
#include "peers.h"
#include <nanoflann.hpp>

#include <cstdio>
#include <utility>
#include <vector>

namespace trysquare::bench {
namespace {

/// The points where they are: nanoflann copies none.
struct PointsAdaptor {
  std::span<const Eigen::Vector3d> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t point, std::size_t axis) const {
    return points[point][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Distance = nanoflann::L2_Simple_Adaptor<double, PointsAdaptor, double, std::uint32_t>;
using Tree = nanoflann::KDTreeSingleIndexAdaptor<Distance, PointsAdaptor, 3, std::uint32_t>;
#if NANOFLANN_VERSION >= 0x150
using Found = nanoflann::ResultItem<std::uint32_t, double>;
const nanoflann::SearchParameters kUnsorted(0, false);
#else
using Found = std::pair<std::uint32_t, double>;
const nanoflann::SearchParams kUnsorted(32, 0, false);
#endif
constexpr std::size_t kPointsPerLeaf = 10;

}  // namespace

Outcome run_nanoflann(const Problem& problem) {
  Outcome outcome;
  const Stopwatch build;
  const PointsAdaptor adaptor{problem.points_in_map};
  Tree tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(kPointsPerLeaf));
  tree.buildIndex();
  outcome.build = build.elapsed();

  const Stopwatch query;
  NeighborhoodValues values;
  std::vector<Found> found;
  const auto point_of = [&](const Found& item) -> const Eigen::Vector3d& { return adaptor.points[item.first]; };
  for (const Eigen::Vector3d& point : problem.queries_in_map()) {
    found.clear();
    tree.radiusSearch(point.data(), problem.radius_m * problem.radius_m, found, kUnsorted);
    outcome.neighbors_sum += found.size();
    if (found.size() >= NeighborhoodValues::kMinNeighbors) values.add(covariance_of(found, point_of));
  }
  values.put_into(outcome);
  outcome.query = query.elapsed();
  return outcome;
}

std::string nanoflann_version() {
  char text[16];
  std::snprintf(text, sizeof(text), "%x.%x.%x", NANOFLANN_VERSION >> 8, NANOFLANN_VERSION >> 4 & 0xf,
                NANOFLANN_VERSION & 0xf);
  return text;
}

}  // namespace trysquare::bench
