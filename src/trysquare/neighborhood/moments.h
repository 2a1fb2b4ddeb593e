// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace trysquare {

/// First two moments of the points in one neighborhood W(p). Paper §III-B.
struct Moments {
  std::uint32_t count = 0;      ///< Points in W(p), the query point included when it is a map point.
  std::uint32_t num_scans = 0;  ///< Distinct scans among them; 0 when the map carries no scan identity.
  Eigen::Vector3d mean_from_query = Eigen::Vector3d::Zero();  ///< Mean minus the query point [m].
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();       ///< Sample covariance Σ, divisor count − 1 [m²].
};

/// Accumulates the moments of one neighborhood in one pass.
///
/// Sums are taken about `query`, so only distances up to the search radius enter: the result does not lose digits
/// when the map lies far from the origin (UTM). Numerical contract, asserted by
/// MomentsProperty.SmallestEigenvalueSurvivesUtmCoordinates: the relative error of the smallest eigenvalue is below
/// 1e-5 for σ >= 0.1 mm, radius <= 1 m, |query| <= 5e6 m (rounding of the coordinates themselves included).
class MomentsAccumulator {
 public:
  explicit MomentsAccumulator(const Eigen::Vector3d& query) : query_(query) {}

  void add(const Eigen::Vector3d& point) {
    const Eigen::Vector3d d = point - query_;
    ++count_;
    sum_ += d;
    sum_of_squares_.noalias() += d * d.transpose();
  }

  /// Returns count and mean for any count; covariance is zero when count < 2. num_scans is the caller's to fill in.
  Moments result() const;

 private:
  Eigen::Vector3d query_;
  std::uint32_t count_ = 0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d sum_of_squares_ = Eigen::Matrix3d::Zero();
};

}  // namespace trysquare
