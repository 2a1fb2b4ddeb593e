// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/moments.h"

namespace trysquare {

Moments MomentsAccumulator::result() const {
  if (count_ == 0) return {};
  const double n = count_;
  Moments moments{.count = count_, .mean_from_query = sum_ / n};
  if (count_ >= 2) moments.covariance = (sum_of_squares_ - sum_ * sum_.transpose() / n) / (n - 1);
  return moments;
}

}  // namespace trysquare
