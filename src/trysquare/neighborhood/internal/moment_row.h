// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/neighborhood/moments.h"

#include <Eigen/Core>

#include <cstddef>

namespace trysquare {

/// Sums over some points, about a point that the owner knows: what the engine adds up. A row of ten doubles, of which
/// the first eight fill one AVX-512 register: Σx Σy Σz Σxx Σxy Σxz Σyy Σyz | Σzz n.
struct alignas(16) MomentRow {
  static constexpr std::size_t kSize = 10;
  double sums[kSize] = {};

  double count() const { return sums[9]; }
  Eigen::Vector3d sum() const { return {sums[0], sums[1], sums[2]}; }

  void add_point(double x, double y, double z) {
    sums[0] += x;
    sums[1] += y;
    sums[2] += z;
    sums[3] += x * x;
    sums[4] += x * y;
    sums[5] += x * z;
    sums[6] += y * y;
    sums[7] += y * z;
    sums[8] += z * z;
    sums[9] += 1;
  }

  void add(const MomentRow& other) {
    for (std::size_t i = 0; i < kSize; ++i) sums[i] += other.sums[i];
  }

  /// The same points about another point: `offset` is the old one minus the new one.
  MomentRow shifted(const Eigen::Vector3d& offset) const {
    const double n = count();
    const double x = offset.x();
    const double y = offset.y();
    const double z = offset.z();
    return {{sums[0] + n * x, sums[1] + n * y, sums[2] + n * z, sums[3] + 2 * sums[0] * x + n * x * x,
             sums[4] + sums[0] * y + sums[1] * x + n * x * y, sums[5] + sums[0] * z + sums[2] * x + n * x * z,
             sums[6] + 2 * sums[1] * y + n * y * y, sums[7] + sums[1] * z + sums[2] * y + n * y * z,
             sums[8] + 2 * sums[2] * z + n * z * z, n}};
  }
};

}  // namespace trysquare
