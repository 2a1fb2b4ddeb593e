// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trysquare {

/// Two ends, low <= high.
struct Interval {
  double low = 0;
  double high = 0;
};

}  // namespace trysquare
