// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"
#include "trysquare/neighborhood/point_index.h"

#include <nanoflann.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace trysquare {

/// What nanoflann asks of a point set.
struct KdTreePoints {
  PointsView points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points[index][static_cast<Eigen::Index>(axis)];
  }
  template <class BoundingBox>
  bool kdtree_get_bbox(BoundingBox& /*box*/) const {
    return false;  // nanoflann computes it
  }
};

using KdTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, KdTreePoints>, KdTreePoints, 3,
                                                   std::uint32_t>;

class PointIndex::Tree {
 public:
  Tree(PointsView points_in_map, std::span<const std::uint32_t> scans, std::size_t scan_count)
      : source{points_in_map}, scan_of_point(scans), num_scans(scan_count), kd_tree(3, source, {kPointsPerLeaf}) {
    kd_tree.buildIndex();
  }

  KdTreePoints source;
  std::span<const std::uint32_t> scan_of_point;  ///< Empty when the map carries no scan identity.
  std::size_t num_scans;
  KdTree kd_tree;

 private:
  static constexpr std::size_t kPointsPerLeaf = 32;
};

}  // namespace trysquare
