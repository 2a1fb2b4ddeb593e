// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/internal/scans_of_map.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace trysquare {

std::vector<std::uint32_t> evenly_spread_scans(std::size_t num_scans, std::size_t num_chosen) {
  num_chosen = std::min(num_chosen, num_scans);
  std::vector<std::uint32_t> chosen;
  for (std::size_t k = 0; k < num_chosen; ++k) {
    chosen.push_back(static_cast<std::uint32_t>(num_chosen == 1 ? 0 : k * (num_scans - 1) / (num_chosen - 1)));
  }
  return chosen;
}

void require_points_of_scans(const RegisteredMap& map) {
  if (map.points_in_map.size() != map.scan_of_point.size()) {
    throw InvalidArgument(fmt::format("orthogonal subset: {} points, but {} scan indices: one is needed for each",
                                      map.points_in_map.size(), map.scan_of_point.size()));
  }
  for (std::size_t i = 0; i < map.points_in_map.size(); ++i) {
    if (!map.points_in_map[i].allFinite()) {
      throw InvalidArgument(fmt::format("orthogonal subset: point {} is not finite", i));
    }
  }
}

PointsView points_of_scan(const RegisteredMap& map, std::uint32_t scan) {
  const auto [begin, end] = std::equal_range(map.scan_of_point.begin(), map.scan_of_point.end(), scan);
  return PointsView(map.points_in_map)
      .subspan(static_cast<std::size_t>(begin - map.scan_of_point.begin()), static_cast<std::size_t>(end - begin));
}

}  // namespace trysquare
