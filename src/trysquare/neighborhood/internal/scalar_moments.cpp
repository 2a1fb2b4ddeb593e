// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/internal/scalar_moments.h"

#include "trysquare/neighborhood/internal/points_within.h"

#include <cstddef>
#include <cstdint>

namespace trysquare {

Moments moments_in_two_passes(const std::vector<Eigen::Vector3d>& from_query) {
  Moments moments{.count = static_cast<std::uint32_t>(from_query.size())};
  if (from_query.empty()) return moments;
  for (const Eigen::Vector3d& d : from_query) moments.mean_from_query += d;
  moments.mean_from_query /= static_cast<double>(from_query.size());
  if (from_query.size() < 2) return moments;
  for (const Eigen::Vector3d& d : from_query) {
    const Eigen::Vector3d from_mean = d - moments.mean_from_query;
    moments.covariance.noalias() += from_mean * from_mean.transpose();
  }
  moments.covariance /= static_cast<double>(from_query.size() - 1);
  return moments;
}

Moments ScalarMoments::around(const Eigen::Vector3d& query, double radius_m) {
  from_query_.clear();
  scans_.start_neighborhood();
  for_each_point_within(tree_, query, radius_m, [&](std::size_t i) {
    from_query_.push_back(tree_.packed.point(i) - query);
    if (tree_.has_scans()) scans_.add(tree_.scans[i]);
  });
  Moments moments = moments_in_two_passes(from_query_);
  moments.num_scans = scans_.count();
  return moments;
}

}  // namespace trysquare
