// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/some_scans.h"

namespace trysquare {

Trajectory take(const Trajectory& trajectory, const std::vector<std::size_t>& which) {
  Trajectory result;
  for (const std::size_t i : which) {
    result.world_from_scan.push_back(trajectory.world_from_scan.at(i));
    if (!trajectory.stamps_ns.empty()) result.stamps_ns.push_back(trajectory.stamps_ns.at(i));
  }
  return result;
}

}  // namespace trysquare
