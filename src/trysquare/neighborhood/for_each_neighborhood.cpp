// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/for_each_neighborhood.h"

#include "trysquare/core/error.h"
#include "trysquare/neighborhood/internal/kd_tree.h"
#include "trysquare/parallel/for_each_block.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace trysquare {
namespace {

/// Counts distinct scans without a set that must be cleared: a scan was seen by this neighborhood if its mark says so.
class ScanCounter {
 public:
  explicit ScanCounter(std::size_t num_scans) : last_neighborhood_(num_scans, 0) {}

  void start_neighborhood() {
    ++neighborhood_;
    count_ = 0;
  }
  void add(std::uint32_t scan) {
    if (last_neighborhood_[scan] == neighborhood_) return;
    last_neighborhood_[scan] = neighborhood_;
    ++count_;
  }
  std::uint32_t count() const { return count_; }

 private:
  std::vector<std::uint32_t> last_neighborhood_;
  std::uint32_t neighborhood_ = 0;
  std::uint32_t count_ = 0;
};

/// nanoflann's result set that keeps moments instead of a list of neighbors. The names are nanoflann's.
class MomentsResultSet {
 public:
  using DistanceType = double;
  using IndexType = std::uint32_t;

  MomentsResultSet(const PointIndex::Tree& tree, const Eigen::Vector3d& query, double squared_radius,
                   ScanCounter& scans)
      : tree_(tree), accumulator_(query), squared_radius_(squared_radius), scans_(scans) {
    scans_.start_neighborhood();
  }

  bool full() const { return true; }
  /// A little more than the radius: nanoflann sums its bounds with rounding, and only addPoint decides.
  double worstDist() const { return squared_radius_ * (1 + 1e-9); }

  bool addPoint(double squared_distance, std::uint32_t index) {
    if (squared_distance < squared_radius_) {  // strict, as Open3D and so map-metrics
      accumulator_.add(tree_.source.points[index]);
      if (!tree_.scan_of_point.empty()) scans_.add(tree_.scan_of_point[index]);
    }
    return true;
  }

  Moments moments() const {
    Moments result = accumulator_.result();
    result.num_scans = scans_.count();
    return result;
  }

 private:
  const PointIndex::Tree& tree_;
  MomentsAccumulator accumulator_;
  double squared_radius_;
  ScanCounter& scans_;
};

Moments moments_around(const PointIndex::Tree& tree, const Eigen::Vector3d& query, double radius_m,
                       ScanCounter& scans) {
  if (tree.source.points.empty()) return {};
  MomentsResultSet result(tree, query, radius_m * radius_m, scans);
  tree.kd_tree.findNeighbors(result, query.data(), {});
  return result.moments();
}

}  // namespace

void NeighborhoodSettings::validate() const {
  if (!(radius_m > 0) || !std::isfinite(radius_m)) {
    throw InvalidArgument(fmt::format("radius_m = {} is out of range: it must be positive and finite", radius_m));
  }
  if (min_neighbors < 3) {
    throw InvalidArgument(fmt::format("min_neighbors = {} is out of range: it must be at least 3", min_neighbors));
  }
}

void for_each_neighborhood(const PointIndex& map, PointsView queries_in_map, const NeighborhoodSettings& settings,
                           const Execution& execution, const std::function<void(const NeighborhoodBlock&)>& visit) {
  constexpr std::size_t kQueriesPerBlock = 512;
  settings.validate();
  for_each_block(queries_in_map.size(), kQueriesPerBlock, execution, "neighborhoods", [&](const Block& block) {
    std::vector<Moments> moments;
    moments.reserve(block.end - block.begin);
    ScanCounter scans(map.num_scans());
    for (std::size_t i = block.begin; i < block.end; ++i) {
      if (!queries_in_map[i].allFinite()) throw InvalidArgument(fmt::format("queries_in_map[{}] is not finite", i));
      moments.push_back(moments_around(map.tree(), queries_in_map[i], settings.radius_m, scans));
    }
    visit({block.begin, moments});
  });
}

}  // namespace trysquare
