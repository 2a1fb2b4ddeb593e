// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/stream_neighborhoods.h"

#include "trysquare/neighborhood/internal/moment_row.h"
#include "trysquare/neighborhood/internal/packed_points.h"
#include "trysquare/neighborhood/internal/packed_tree.h"
#include "trysquare/neighborhood/internal/points_within.h"
#include "trysquare/neighborhood/internal/scalar_moments.h"
#include "trysquare/neighborhood/internal/super_groups.h"
#include "trysquare/neighborhood/internal/vector_kernels.h"
#include "trysquare/parallel/for_each_block.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

namespace trysquare {
namespace {

using Tree = PointIndex::Tree;

/// Most leaves are no wider than a few radii when neighbors follow each other.
bool is_scattered(const Tree& tree, double radius_m) {
  const Boxes& boxes = tree.packed.leaf_boxes;
  std::size_t num_wide = 0;
  for (std::size_t leaf = 0; leaf < boxes.size; ++leaf) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (boxes.hi[axis][leaf] - boxes.lo[axis][leaf] > 4 * radius_m) {
        ++num_wide;
        break;
      }
    }
  }
  return 2 * num_wide > boxes.size;
}

/// One run over the scans, which knows the queries.
class Stream {
 public:
  Stream(std::size_t num_scans, const PointsOfScan& points_of_scan, PointsView queries_in_map, double radius_m,
         const Execution& execution)
      : num_scans_(num_scans),
        points_of_scan_(points_of_scan),
        radius_m_(radius_m),
        execution_(execution),
        cube_(hilbert_cube_around(queries_in_map)),
        queries_(queries_in_map, hilbert_order(queries_in_map, cube_, execution), cube_.origin(), execution),
        groups_(super_groups(queries_, radius_m)),
        kernels_(vector_kernels().front()),
        sums_(queries_.num_points),
        num_scans_near_(queries_.num_points, 0) {}

  void run(const std::function<void(const NeighborhoodBlock&)>& visit) {
    const bool vectors = fits_single_precision(cube_.edge_m, radius_m_);
    std::vector<std::uint32_t> plain;  // packed indices of queries whose sums would not be accurate
    std::vector<Moments> moments(queries_.num_points);
    if (vectors) {
      add_all_scans();
      for (const SuperGroup& group : groups_) finish(group, moments, plain);
    } else {
      for (std::uint32_t i = 0; i < queries_.num_points; ++i) plain.push_back(i);
    }
    if (!plain.empty()) look_again(plain, moments);
    for (const SuperGroup& group : groups_) {
      visit({std::span(queries_.original_index).subspan(group.first_query, group.num_queries),
             std::span(moments).subspan(group.first_query, group.num_queries)});
    }
  }

 private:
  /// Runs body(scan, tree) for every scan, some at a time, and then in the order of the scans `in_order(position)`.
  template <class Body, class InOrder>
  void for_each_scan(const Body& body, const InOrder& in_order) {
    for (std::size_t begin = 0; begin < num_scans_; begin += kScansAtOnce) {
      const std::size_t count = std::min(kScansAtOnce, num_scans_ - begin);
      for_each_block(count, 1, {.num_threads = execution_.num_threads}, "", [&](const Block& block) {
        const std::vector<Eigen::Vector3d> points = points_of_scan_(begin + block.index);
        validate_points("points_of_scan", points);
        if (!points.empty()) body(block.index, tree_of(points));
      });
      for (std::size_t position = 0; position < count; ++position) in_order(position);
      if (execution_.progress) execution_.progress("scans", begin + count, num_scans_);
    }
  }

  Tree tree_of(PointsView points) const {
    Tree tree(points, {}, queries_.origin);
    if (!is_scattered(tree, radius_m_)) return tree;
    return {points, hilbert_order(points, hilbert_cube_around(points), {.num_threads = 1}), queries_.origin};
  }

  void add_all_scans() {
    std::vector<std::vector<MomentRow>> sums_of_scan(std::min(kScansAtOnce, num_scans_));
    for_each_scan([&](std::size_t position, const Tree& tree) { sums_of_scan[position] = sums_over(tree); },
                  [&](std::size_t position) {
                    for (std::size_t i = 0; i < sums_of_scan[position].size(); ++i) {
                      sums_[i].add(sums_of_scan[position][i]);
                      if (sums_of_scan[position][i].count() > 0) ++num_scans_near_[i];
                    }
                    sums_of_scan[position].clear();
                  });
  }

  std::vector<MomentRow> sums_over(const Tree& tree) const {
    std::vector<MomentRow> sums(queries_.num_points);
    const auto scratch = std::make_unique<BallScratch>(0);
    for (const SuperGroup& group : groups_) {
      start_super_group(tree, queries_, radius_m_, group, *scratch);
      kernels_.add_balls(tree, queries_, radius_m_, group, *scratch);
      for (std::size_t i = 0; i < group.num_queries; ++i) sums[group.first_query + i] = sums_of_query(*scratch, i);
    }
    return sums;
  }

  void finish(const SuperGroup& group, std::vector<Moments>& moments, std::vector<std::uint32_t>& plain) const {
    const Eigen::Vector3d center = center_of(queries_, group);
    for (std::size_t i = group.first_query; i < group.first_query + group.num_queries; ++i) {
      moments[i] = moments_from(sums_[i], queries_.point(i) - center);
      moments[i].num_scans = num_scans_near_[i];
      if (cancels(sums_[i], moments[i])) plain.push_back(static_cast<std::uint32_t>(i));
    }
  }

  /// The plain way for some queries: their neighbors are kept.
  void look_again(const std::vector<std::uint32_t>& which, std::vector<Moments>& moments) {
    using Neighbors = std::vector<std::vector<Eigen::Vector3d>>;  // from the query
    Neighbors neighbors(which.size());
    std::vector<std::uint32_t> num_scans_near(which.size(), 0);
    std::vector<Neighbors> of_scan(std::min(kScansAtOnce, num_scans_));
    for_each_scan(
        [&](std::size_t position, const Tree& tree) {
          of_scan[position].resize(which.size());
          for (std::size_t i = 0; i < which.size(); ++i) {
            const Eigen::Vector3d query = queries_.point(which[i]);
            for_each_point_within(tree, query, radius_m_, [&](std::size_t point) {
              of_scan[position][i].push_back(tree.packed.point(point) - query);
            });
          }
        },
        [&](std::size_t position) {
          for (std::size_t i = 0; i < of_scan[position].size(); ++i) {
            const std::vector<Eigen::Vector3d>& more = of_scan[position][i];
            neighbors[i].insert(neighbors[i].end(), more.begin(), more.end());
            if (!more.empty()) ++num_scans_near[i];
          }
          of_scan[position].clear();
        });
    for (std::size_t i = 0; i < which.size(); ++i) {
      moments[which[i]] = moments_in_two_passes(neighbors[i]);
      moments[which[i]].num_scans = num_scans_near[i];
    }
  }

  static constexpr std::size_t kScansAtOnce = 16;  // not the number of threads: sums must not depend on it

  std::size_t num_scans_;
  const PointsOfScan& points_of_scan_;
  double radius_m_;
  const Execution& execution_;
  HilbertCube cube_;
  PackedPoints queries_;
  std::vector<SuperGroup> groups_;
  VectorKernels kernels_;
  std::vector<MomentRow> sums_;
  std::vector<std::uint32_t> num_scans_near_;
};

}  // namespace

void stream_neighborhoods(std::size_t num_scans, const PointsOfScan& points_of_scan, PointsView queries_in_map,
                          const NeighborhoodSettings& settings, const Execution& execution,
                          const std::function<void(const NeighborhoodBlock&)>& visit) {
  settings.validate();
  execution.validate();
  validate_points("queries_in_map", queries_in_map);
  Stream(num_scans, points_of_scan, queries_in_map, settings.radius_m, execution).run(visit);
}

}  // namespace trysquare
