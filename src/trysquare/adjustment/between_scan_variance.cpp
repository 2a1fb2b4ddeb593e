// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/between_scan_variance.h"

#include "trysquare/metrics/orthogonal_triad.h"
#include "trysquare/stats/median.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace trysquare {
namespace {

/// Mean over pairs of scans of the median over the patches of `direction`.
double variance_along(std::span<const ObservedPatch> patches, const std::vector<std::uint8_t>& directions,
                      std::uint8_t direction) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<double>> of_pair;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (directions[p] != direction) continue;
    const std::vector<PatchObservation>& seen = patches[p].observations;
    for (std::size_t j = 0; j < seen.size(); ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        const double apart_m = seen[j].intercept_m - seen[i].intercept_m;
        of_pair[{seen[i].scan, seen[j].scan}].push_back(apart_m * apart_m - seen[i].variance_m2 - seen[j].variance_m2);
      }
    }
  }
  double sum = 0;
  for (const auto& [pair, values] : of_pair) sum += median_of_defined(values).value_or(0);
  return sum / static_cast<double>(of_pair.size());
}

}  // namespace

BetweenScanVariance between_scan_variance(std::span<const ObservedPatch> patches) {
  std::vector<ObservedPatch> seen;
  std::vector<Eigen::Vector3d> normals;
  for (const ObservedPatch& patch : patches) {
    if (patch.observations.size() < 2) continue;
    seen.push_back(patch);
    normals.push_back(patch.normal_in_map);
  }
  const OrthogonalTriad triad = orthogonal_triad(normals);
  BetweenScanVariance result;
  double sum_m2 = 0;
  for (std::size_t k = 0; k < triad.directions.size(); ++k) {
    const auto direction = static_cast<std::uint8_t>(k);
    const double variance_m2 = variance_along(seen, triad.direction_of_normal, direction);
    result.directions.push_back({.axis_in_map = triad.directions[k].axis,
                                 .num_patches = triad.directions[k].num_normals,
                                 .variance_m2 = variance_m2});
    sum_m2 += variance_m2;
  }
  if (result.directions.size() == 3) result.mom_debiased_m = std::sqrt(std::max(0.0, sum_m2));
  return result;
}

}  // namespace trysquare
