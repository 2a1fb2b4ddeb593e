// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/nearest_neighbor_normals.h"

#include "trysquare/core/error.h"
#include "trysquare/parallel/for_each_block.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <nanoflann.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace trysquare {
namespace {

/// What nanoflann asks of a set of points.
struct Cloud {
  PointsView points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points[index][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::uint32_t>;

/// The eigenvector of the smallest eigenvalue, its largest component positive.
Eigen::Vector3d normal_of(PointsView points, std::span<const std::uint32_t> chosen) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : chosen) mean += points[i];
  mean /= static_cast<double>(chosen.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : chosen) covariance += (points[i] - mean) * (points[i] - mean).transpose();
  const Eigen::Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0);
  Eigen::Index largest = 0;
  normal.cwiseAbs().maxCoeff(&largest);
  return normal[largest] < 0 ? Eigen::Vector3d(-normal) : normal;
}

/// One query after the other, with room for what is found.
class Search {
 public:
  Search(const Tree& tree, PointsView points, double radius_m, std::size_t max_nearest)
      : tree_(tree),
        points_(points),
        squared_radius_(radius_m * radius_m),
        indices_(max_nearest),
        squared_distances_(max_nearest) {}

  Eigen::Vector3d normal_at(const Eigen::Vector3d& query) {
    std::size_t count = tree_.knnSearch(query.data(), indices_.size(), indices_.data(), squared_distances_.data());
    while (count > 0 && !(squared_distances_[count - 1] < squared_radius_)) --count;
    if (count < 3) return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    return normal_of(points_, std::span(indices_).first(count));
  }

 private:
  const Tree& tree_;
  PointsView points_;
  double squared_radius_;
  std::vector<std::uint32_t> indices_;
  std::vector<double> squared_distances_;
};

}  // namespace

std::vector<Eigen::Vector3d> nearest_neighbor_normals(PointsView scan, PointsView queries, double radius_m,
                                                      std::size_t max_nearest, const Execution& execution) {
  constexpr std::size_t kQueriesPerBlock = 1024;
  constexpr std::size_t kPointsPerLeaf = 10;
  if (!(radius_m > 0) || !std::isfinite(radius_m)) {
    throw InvalidArgument(fmt::format("radius_m = {} is out of range: it must be positive and finite", radius_m));
  }
  if (max_nearest < 3) {
    throw InvalidArgument(fmt::format("max_nearest = {} is out of range: it must be at least 3", max_nearest));
  }
  std::vector<Eigen::Vector3d> normals(queries.size());
  const Cloud cloud{scan};
  Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(kPointsPerLeaf));
  tree.buildIndex();
  for_each_block(queries.size(), kQueriesPerBlock, execution, "normals", [&](const Block& block) {
    Search search(tree, scan, radius_m, max_nearest);
    for (std::size_t i = block.begin; i < block.end; ++i) normals[i] = search.normal_at(queries[i]);
  });
  return normals;
}

}  // namespace trysquare
