// SPDX-License-Identifier: Apache-2.0
// Neighborhoods on real data against nanoflann's lists of neighbors and long double: every compiled variant, in the map
// frame and in UTM coordinates. Real coordinates have three decimals, so that many distances are exact ties.
#include "trysquare/io/scan_files.h"
#include "trysquare/io/trajectory_file.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/neighborhood/eigenvalues.h"
#include "trysquare/neighborhood/internal/visit_neighborhoods.h"

#include "oracle_data.h"
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <nanoflann.hpp>

#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace trysquare {
namespace {

using Real = long double;

struct DataSet {
  std::string name;
  std::string scans;
  std::string poses;
  std::size_t num_scans;
  double radius_m;
};

void PrintTo(const DataSet& data, std::ostream* out) { *out << data.name; }

const DataSet kDataSets[] = {
    {"KittiOneScan", "kitti00/velodyne", "kitti00/poses.txt", 1, 1.0},
    {"KittiOneScanSmallBalls", "kitti00/velodyne", "kitti00/poses.txt", 1, 0.3},
    {"KittiFiveScans", "kitti00/velodyne", "kitti00/poses.txt", 5, 0.5},
    {"Depth", "arcore-depth/pcs", "arcore-depth/poses", 0, 0.2},
};

RegisteredMap map_of(const DataSet& data) {
  const auto folder = oracle::data_folder();
  const ScanFiles scans = open_scans((folder / data.scans).string());
  return assemble_map(scans, read_trajectory((folder / data.poses).string()).trajectory, {.num_scans = data.num_scans})
      .map;
}

struct NanoflannPoints {
  PointsView points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

struct Expected {
  std::size_t count = 0;
  Real lowest = 0;   ///< λ₁
  Real highest = 0;  ///< λ₃
};

/// Of every `every`-th point.
std::vector<Expected> by_nanoflann(const std::vector<Eigen::Vector3d>& points, double radius_m, std::size_t every) {
  const NanoflannPoints source{points};
  using Distance = nanoflann::L2_Simple_Adaptor<double, NanoflannPoints>;
  nanoflann::KDTreeSingleIndexAdaptor<Distance, NanoflannPoints, 3, std::uint32_t> tree(3, source, {10});
  tree.buildIndex();
  std::vector<Expected> expected;
  std::vector<std::pair<std::uint32_t, double>> neighbors;
  for (std::size_t i = 0; i < points.size(); i += every) {
    tree.radiusSearch(points[i].data(), radius_m * radius_m, neighbors, {});
    Eigen::Matrix<Real, 3, 1> mean = Eigen::Matrix<Real, 3, 1>::Zero();
    for (const auto& neighbor : neighbors) mean += points[neighbor.first].cast<Real>();
    mean /= static_cast<Real>(neighbors.size());
    Eigen::Matrix<Real, 3, 3> squares = Eigen::Matrix<Real, 3, 3>::Zero();
    for (const auto& neighbor : neighbors) {
      const Eigen::Matrix<Real, 3, 1> d = points[neighbor.first].cast<Real>() - mean;
      squares += d * d.transpose();
    }
    expected.push_back({.count = neighbors.size()});
    if (neighbors.size() < 2) continue;
    squares /= static_cast<Real>(neighbors.size() - 1);
    const auto lambda =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix<Real, 3, 3>>(squares, Eigen::EigenvaluesOnly).eigenvalues().eval();
    expected.back().lowest = std::max(lambda[0], Real{0});
    expected.back().highest = lambda[2];
  }
  return expected;
}

class RealNeighborhoods : public testing::TestWithParam<DataSet> {};

TEST_P(RealNeighborhoods, AreThoseOfNanoflann) {
  TRYSQUARE_REQUIRE_ORACLE("map_oracle.json");
  constexpr std::size_t kEvery = 3;
  RegisteredMap map = map_of(GetParam());
  for (const Eigen::Vector3d& offset_m : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(431'234.5, 5'412'345.25, 213)}) {
    for (Eigen::Vector3d& point : map.points_in_map) point += offset_m;
    const std::vector<Expected> expected = by_nanoflann(map.points_in_map, GetParam().radius_m, kEvery);
    const PointIndex index(map);
    for (const VectorKernels& kernels : vector_kernels()) {
      std::vector<std::uint32_t> counts(map.points_in_map.size());
      std::vector<double> lowest(map.points_in_map.size());
      visit_neighborhoods(&kernels, index, map.points_in_map, {.radius_m = GetParam().radius_m}, {},
                          [&](const NeighborhoodBlock& block) {
                            std::vector<Eigen::Vector3d> lambdas(block.moments.size());
                            kernels.eigenvalues(block.moments, lambdas);
                            for (std::size_t i = 0; i < lambdas.size(); ++i) {
                              counts[block.queries[i]] = block.moments[i].count;
                              lowest[block.queries[i]] = lambdas[i][0];
                            }
                          });
      for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_EQ(counts[i * kEvery], expected[i].count) << kernels.name << ", point " << i * kEvery;
        ASSERT_LE(std::abs(lowest[i * kEvery] - expected[i].lowest), 1e-12L * expected[i].highest)
            << kernels.name << ", point " << i * kEvery;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Nanoflann, RealNeighborhoods, testing::ValuesIn(kDataSets),
                         [](const auto& data) { return data.param.name; });

}  // namespace
}  // namespace trysquare
