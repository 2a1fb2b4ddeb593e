// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/ghost_walls.h"

#include "trysquare/stats/median.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace trysquare {
namespace {

constexpr double kLeastDistance_m = 0.05;
constexpr double kLeastDistanceInSigmas = 4;  ///< Normal noise splits at 2.7 of them, a steady drift at 3.5.
constexpr double kClearDistanceInSigmas = 8;
constexpr std::size_t kScansPerChange = 5;
constexpr double kLeastDistanceInNoise = 2.5;
constexpr double kLeastGap = 0.5;  ///< Between the groups, of their distance.
constexpr std::size_t kFewestScans = 3;
constexpr std::size_t kFewestPatches = 3;
constexpr double kReach_m = 4;
constexpr double kLeastCosine = 0.985;   ///< 10 degrees.
constexpr double kPlaneOffset_m = 0.4;   ///< From one patch's plane to the next one's center.
constexpr double kLeastAgreement = 0.8;  ///< Observations on the side that their scan is on in the other patches.

/// One patch whose scans fall into two groups.
struct Split {
  std::size_t patch = 0;
  double distance_m = 0;
  double limit_m = 0;
  double sigma_m = 0;
  double middle_m = 0;  ///< Intercepts above belong to the upper group.
};

double median(const std::vector<double>& values) { return median_of_defined(values).value_or(0); }

/// How many of the sorted values belong to the lower of two groups.
std::size_t size_of_lower(const std::vector<double>& sorted) {
  const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  double lower_sum = 0;
  double most_between = -1;
  std::size_t best = 0;
  for (std::size_t lower = 1; lower < sorted.size(); ++lower) {
    lower_sum += sorted[lower - 1];
    const auto n = static_cast<double>(lower);
    const auto m = static_cast<double>(sorted.size() - lower);
    const double apart = lower_sum / n - (sum - lower_sum) / m;
    if (const double between = n * m * apart * apart; between > most_between) {
      most_between = between;
      best = lower;
    }
  }
  return best;
}

/// Standard deviation within the two groups, at least what the noise within the scans makes.
double sigma_within(const ObservedPatch& patch, const std::vector<double>& lower, const std::vector<double>& upper) {
  double sum_of_squares = 0;
  for (const std::vector<double>* group : {&lower, &upper}) {
    const double mean = std::accumulate(group->begin(), group->end(), 0.0) / static_cast<double>(group->size());
    for (const double value : *group) sum_of_squares += (value - mean) * (value - mean);
  }
  std::vector<double> variances;
  for (const PatchObservation& seen : patch.observations) variances.push_back(seen.variance_m2);
  const double variance = sum_of_squares / static_cast<double>(lower.size() + upper.size() - 2);
  return std::sqrt(std::max(variance, median(variances)));
}

std::optional<Split> split_of(const ObservedPatch& patch, std::size_t index) {
  if (patch.observations.size() < 2 * kFewestScans) return std::nullopt;
  std::vector<double> sorted;
  for (const PatchObservation& seen : patch.observations) sorted.push_back(seen.intercept_m);
  std::sort(sorted.begin(), sorted.end());
  const std::size_t num_lower = size_of_lower(sorted);
  if (num_lower < kFewestScans || sorted.size() - num_lower < kFewestScans) return std::nullopt;
  const auto border = sorted.begin() + static_cast<std::ptrdiff_t>(num_lower);
  const std::vector<double> lower(sorted.begin(), border);
  const std::vector<double> upper(border, sorted.end());
  const double distance_m = median(upper) - median(lower);
  const double sigma_m = sigma_within(patch, lower, upper);
  const double least_m =
      std::max({kLeastDistance_m, kLeastDistanceInSigmas * sigma_m, kLeastDistanceInNoise * patch.within_scan_sigma_m});
  if (distance_m < least_m || upper.front() - lower.back() < kLeastGap * distance_m) return std::nullopt;
  return Split{.patch = index,
               .distance_m = distance_m,
               .limit_m = least_m,
               .sigma_m = sigma_m,
               .middle_m = 0.5 * (lower.back() + upper.front())};
}

/// Two patches of one plane that are near each other.
bool are_neighbors(const ObservedPatch& p, const ObservedPatch& q) {
  const Eigen::Vector3d between = q.center_in_map - p.center_in_map;
  return between.norm() <= kReach_m && std::abs(p.normal_in_map.dot(q.normal_in_map)) >= kLeastCosine &&
         std::abs(p.normal_in_map.dot(between)) <= kPlaneOffset_m;
}

/// Splits in groups of neighbors, each grown from its first one.
std::vector<std::vector<Split>> grouped(std::vector<Split> splits, std::span<const ObservedPatch> patches) {
  std::vector<std::vector<Split>> groups;
  while (!splits.empty()) {
    std::vector<Split> group{splits.front()};
    splits.erase(splits.begin());
    for (std::size_t next = 0; next < group.size(); ++next) {
      const ObservedPatch& from = patches[group[next].patch];
      const auto others = std::stable_partition(
          splits.begin(), splits.end(), [&](const Split& each) { return are_neighbors(from, patches[each.patch]); });
      group.insert(group.end(), splits.begin(), others);
      splits.erase(splits.begin(), others);
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

bool holds(const std::vector<std::uint32_t>& scans, std::uint32_t scan) {
  return std::binary_search(scans.begin(), scans.end(), scan);
}

/// Distance between the two groups of scans on one patch; nothing where one of the groups does not see it.
std::optional<double> distance_between(const ObservedPatch& patch, const GhostWall& wall) {
  const double sign = patch.normal_in_map.dot(wall.normal_in_map) < 0 ? -1.0 : 1.0;
  std::vector<double> lower;
  std::vector<double> upper;
  for (const PatchObservation& seen : patch.observations) {
    if (holds(wall.lower_scans, seen.scan)) lower.push_back(sign * seen.intercept_m);
    if (holds(wall.upper_scans, seen.scan)) upper.push_back(sign * seen.intercept_m);
  }
  if (lower.empty() || upper.empty()) return std::nullopt;
  return median(upper) - median(lower);
}

/// Which scan sees which surface, by the majority of the patches, and how many observations agree with it.
double divide_scans(const std::vector<Split>& group, std::span<const ObservedPatch> given, GhostWall& wall) {
  std::map<std::uint32_t, int> votes;  // for the upper group
  double num_votes = 0;
  for (const Split& each : group) {
    const ObservedPatch& patch = given[each.patch];
    const double sign = patch.normal_in_map.dot(wall.normal_in_map) < 0 ? -1.0 : 1.0;
    for (const PatchObservation& seen : patch.observations) {
      votes[seen.scan] += sign * (seen.intercept_m - each.middle_m) > 0 ? 1 : -1;
      ++num_votes;
    }
  }
  double num_agreeing = 0;
  for (const auto& [scan, vote] : votes) {
    num_agreeing += std::abs(vote);
    if (vote != 0) (vote > 0 ? wall.upper_scans : wall.lower_scans).push_back(scan);
  }
  return 0.5 * (1 + num_agreeing / num_votes);
}

double extent_of(const std::vector<Split>& group, std::span<const ObservedPatch> given) {
  double extent_m = 0;
  for (const Split& a : group) {
    for (const Split& b : group) {
      extent_m = std::max(extent_m, (given[a.patch].center_in_map - given[b.patch].center_in_map).norm());
    }
  }
  return extent_m;
}

/// Whether at least half of the patches there that both groups of scans see are split: single ones are corners, where a
/// patch touches another surface.
bool is_seen_all_over(const GhostWall& wall, const std::vector<Split>& group, std::span<const ObservedPatch> given) {
  std::size_t num_seen_by_both = 0;
  for (const ObservedPatch& patch : given) {
    const auto is_near = [&](const Split& each) { return are_neighbors(given[each.patch], patch); };
    if (std::none_of(group.begin(), group.end(), is_near)) continue;
    std::size_t num_lower = 0;
    std::size_t num_upper = 0;
    for (const PatchObservation& seen : patch.observations) {
      if (holds(wall.lower_scans, seen.scan)) ++num_lower;
      if (holds(wall.upper_scans, seen.scan)) ++num_upper;
    }
    if (num_lower >= kFewestScans && num_upper >= kFewestScans) ++num_seen_by_both;
  }
  return 2 * group.size() >= num_seen_by_both;
}

/// Changes from one group to the other along the sequence of the scans that see the wall.
std::size_t num_changes(const GhostWall& wall) {
  std::vector<std::pair<std::uint32_t, bool>> sides;
  for (const std::uint32_t scan : wall.lower_scans) sides.emplace_back(scan, false);
  for (const std::uint32_t scan : wall.upper_scans) sides.emplace_back(scan, true);
  std::sort(sides.begin(), sides.end());
  std::size_t changes = 0;
  for (std::size_t i = 1; i < sides.size(); ++i) changes += sides[i].second != sides[i - 1].second ? 1U : 0U;
  return changes;
}

/// Whether chance hardly makes such groups.
bool is_no_chance(const GhostWall& wall) {
  const std::size_t num_scans = wall.lower_scans.size() + wall.upper_scans.size();
  return kScansPerChange * num_changes(wall) <= std::max(num_scans, kScansPerChange) ||
         wall.distance_m >= kClearDistanceInSigmas * wall.noise_m;
}

/// The wall that a group of splits makes; nothing when they are too few or contradict each other.
std::optional<GhostWall> wall_of(const std::vector<Split>& group, std::span<const ObservedPatch> given,
                                 std::span<const ObservedPatch> adjusted) {
  if (group.size() < kFewestPatches) return std::nullopt;
  GhostWall wall{.normal_in_map = given[group.front().patch].normal_in_map, .num_patches = group.size()};
  if (divide_scans(group, given, wall) < kLeastAgreement) return std::nullopt;
  if (wall.lower_scans.size() < kFewestScans || wall.upper_scans.size() < kFewestScans) return std::nullopt;
  if (!is_seen_all_over(wall, group, given)) return std::nullopt;
  std::vector<double> distances;
  std::vector<double> limits;
  std::vector<double> sigmas;
  std::vector<double> adjusted_m;
  for (const Split& each : group) {
    wall.center_in_map += given[each.patch].center_in_map / static_cast<double>(group.size());
    distances.push_back(each.distance_m);
    limits.push_back(each.limit_m);
    sigmas.push_back(each.sigma_m);
    if (adjusted.empty()) continue;
    if (const std::optional<double> m = distance_between(adjusted[each.patch], wall)) {
      adjusted_m.push_back(std::abs(*m));
    }
  }
  wall.distance_m = median(distances);
  wall.limit_m = median(limits);
  wall.noise_m = median(sigmas);
  wall.extent_m = extent_of(group, given);
  wall.adjusted_m = median_of_defined(adjusted_m);
  if (!is_no_chance(wall)) return std::nullopt;
  return wall;
}

}  // namespace

std::vector<GhostWall> find_ghost_walls(std::span<const ObservedPatch> given, std::span<const ObservedPatch> adjusted) {
  std::vector<Split> splits;
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (const std::optional<Split> split = split_of(given[i], i)) splits.push_back(*split);
  }
  std::vector<GhostWall> walls;
  for (const std::vector<Split>& group : grouped(std::move(splits), given)) {
    if (std::optional<GhostWall> wall = wall_of(group, given, adjusted)) walls.push_back(std::move(*wall));
  }
  std::stable_sort(walls.begin(), walls.end(),
                   [](const GhostWall& a, const GhostWall& b) { return a.num_patches > b.num_patches; });
  return walls;
}

}  // namespace trysquare
