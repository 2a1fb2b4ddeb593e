// SPDX-License-Identifier: Apache-2.0
#include "neighborhood_values.h"
#include "peers.h"
#include <pcl/common/centroid.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/pcl_config.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vector>

namespace trysquare::bench {

Outcome run_pcl(const Problem& problem) {
  Outcome outcome;
  const Stopwatch build;
  const auto cloud = pcl::PointCloud<pcl::PointXYZ>::Ptr(new pcl::PointCloud<pcl::PointXYZ>);
  cloud->reserve(problem.points_in_map.size());
  for (const Eigen::Vector3d& point : problem.points_in_map) {
    const Eigen::Vector3f rounded = point.cast<float>();
    cloud->emplace_back(rounded.x(), rounded.y(), rounded.z());
  }
  pcl::KdTreeFLANN<pcl::PointXYZ> tree(false);  // false: neighbors need not be sorted
  tree.setInputCloud(cloud);
  outcome.build = build.elapsed();

  const Stopwatch query;
  NeighborhoodValues values;
  pcl::Indices found;
  std::vector<float> squared_distances;
  for (const Eigen::Vector3d& point : problem.queries_in_map()) {
    const Eigen::Vector3f rounded = point.cast<float>();
    tree.radiusSearch(pcl::PointXYZ(rounded.x(), rounded.y(), rounded.z()), problem.radius_m, found, squared_distances);
    outcome.neighbors_sum += found.size();
    if (found.size() < NeighborhoodValues::kMinNeighbors) continue;
    Eigen::Matrix3d covariance;  // sums in double over float points; PCL divides by n
    Eigen::Vector4d centroid;
    pcl::computeMeanAndCovarianceMatrix(*cloud, found, covariance, centroid);
    const auto n = static_cast<double>(found.size());
    values.add(covariance * (n / (n - 1)));
  }
  values.put_into(outcome);
  outcome.query = query.elapsed();
  return outcome;
}

std::string pcl_version() { return PCL_VERSION_PRETTY; }

}  // namespace trysquare::bench
