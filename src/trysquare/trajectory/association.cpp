// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/association.h"

#include "trysquare/core/error.h"
#include "trysquare/stats/median.h"
#include "trysquare/trajectory/interpolation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr double kLongest_s = 9e9;  // of an offset or a gap: what 64-bit nanoseconds hold

/// The double next to the stamp in seconds: what a reader that parses "1311868164.363181" as a double has. Whole
/// seconds and the rest apart, because 64-bit nanoseconds do not fit into a double.
double seconds(std::int64_t stamp_ns) {
  return static_cast<double>(stamp_ns / kNanosecondsPerSecond) +
         static_cast<double>(stamp_ns % kNanosecondsPerSecond) / static_cast<double>(kNanosecondsPerSecond);
}

std::int64_t nanoseconds(double seconds) { return std::llround(seconds * static_cast<double>(kNanosecondsPerSecond)); }

std::vector<double> seconds(std::span<const std::int64_t> stamps_ns) {
  std::vector<double> result;
  result.reserve(stamps_ns.size());
  for (const std::int64_t stamp : stamps_ns) result.push_back(seconds(stamp));
  return result;
}

/// Answers "which stamp is nearest?" in O(log N).
class StampIndex {
 public:
  explicit StampIndex(std::span<const double> stamps_s) : order_(stamps_s.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return stamps_s[a] < stamps_s[b]; });
    for (const std::size_t index : order_) sorted_s_.push_back(stamps_s[index]);
  }

  /// Index of the stamp nearest to `stamp_s`; the smallest index of those equally near. REQUIRES one stamp or more.
  std::size_t nearest(double stamp_s) const {
    const auto above = std::lower_bound(sorted_s_.begin(), sorted_s_.end(), stamp_s);
    double smallest = std::numeric_limits<double>::infinity();
    if (above != sorted_s_.end()) smallest = *above - stamp_s;
    if (above != sorted_s_.begin()) smallest = std::min(smallest, stamp_s - *(above - 1));
    // Rounded differences of neighbors may be equal, so all that are as near as the nearest stand side by side.
    const auto first = std::partition_point(sorted_s_.begin(), above, [&](double s) { return stamp_s - s > smallest; });
    const auto last = std::partition_point(above, sorted_s_.end(), [&](double s) { return s - stamp_s <= smallest; });
    return *std::min_element(order_.begin() + (first - sorted_s_.begin()), order_.begin() + (last - sorted_s_.begin()));
  }

 private:
  std::vector<std::size_t> order_;  ///< Indices in the order of time.
  std::vector<double> sorted_s_;
};

struct Matches {
  std::vector<std::size_t> in_short;
  std::vector<std::size_t> in_long;
};

std::vector<std::optional<std::size_t>> nearest(std::span<const double> queries_s, std::span<const double> stamps_s,
                                                double max_difference_s) {
  std::vector<std::optional<std::size_t>> result(queries_s.size());
  if (stamps_s.empty()) return result;
  const StampIndex index(stamps_s);
  for (std::size_t i = 0; i < queries_s.size(); ++i) {
    const std::size_t j = index.nearest(queries_s[i]);
    if (std::abs(stamps_s[j] - queries_s[i]) <= max_difference_s) result[i] = j;
  }
  return result;
}

Matches match(std::span<const double> short_s, std::span<const double> long_s, double max_difference_s) {
  const std::vector<std::optional<std::size_t>> in_long = nearest(short_s, long_s, max_difference_s);
  Matches matches;
  for (std::size_t i = 0; i < in_long.size(); ++i) {
    if (!in_long[i]) continue;
    matches.in_short.push_back(i);
    matches.in_long.push_back(*in_long[i]);
  }
  return matches;
}

Trajectory subset(const Trajectory& trajectory, std::span<const std::size_t> indices) {
  Trajectory result;
  for (const std::size_t i : indices) {
    result.world_from_scan.push_back(trajectory.world_from_scan[i]);
    result.stamps_ns.push_back(trajectory.stamps_ns[i]);
  }
  return result;
}

std::size_t num_distinct(std::vector<std::size_t> indices) {
  std::sort(indices.begin(), indices.end());
  return static_cast<std::size_t>(std::unique(indices.begin(), indices.end()) - indices.begin());
}

AssociatedTrajectories associate_by_index(const Trajectory& reference, const Trajectory& estimate) {
  if (reference.size() != estimate.size()) {
    throw InvalidArgument(fmt::format(
        "the reference has {} poses and the estimate {}: without time stamps in both they need equally many",
        reference.size(), estimate.size()));
  }
  AssociatedTrajectories result{
      .reference = reference, .estimate = estimate, .num_pairs = reference.size(), .by_index = true};
  result.estimate_indices.resize(estimate.size());
  std::iota(result.estimate_indices.begin(), result.estimate_indices.end(), std::size_t{0});
  return result;
}

/// Of the pairs with the same pose of the longer trajectory the one nearest in time stays, the earliest of equal ones.
void keep_nearest_of_each(Matches& matches, std::span<const double> short_s, std::span<const double> long_s) {
  const auto difference_s = [&](std::size_t pair) {
    return std::abs(short_s[matches.in_short[pair]] - long_s[matches.in_long[pair]]);
  };
  std::unordered_map<std::size_t, std::size_t> best_pair;
  for (std::size_t pair = 0; pair < matches.in_long.size(); ++pair) {
    const auto [best, is_first] = best_pair.emplace(matches.in_long[pair], pair);
    if (!is_first && difference_s(pair) < difference_s(best->second)) best->second = pair;
  }
  Matches kept;
  for (std::size_t pair = 0; pair < matches.in_long.size(); ++pair) {
    if (best_pair.at(matches.in_long[pair]) != pair) continue;
    kept.in_short.push_back(matches.in_short[pair]);
    kept.in_long.push_back(matches.in_long[pair]);
  }
  matches = std::move(kept);
}

std::optional<double> median_difference_s(const Matches& matches, std::span<const double> short_s,
                                          std::span<const double> long_s) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < matches.in_short.size(); ++i) {
    differences.push_back(std::abs(short_s[matches.in_short[i]] - long_s[matches.in_long[i]]));
  }
  return median_of_defined(differences);
}

/// stamp_ns + offset_s, or nothing where 64 bits cannot hold it.
std::optional<std::int64_t> shifted(std::int64_t stamp_ns, double offset_s) {
  using Limits = std::numeric_limits<std::int64_t>;
  if (std::abs(offset_s) > kLongest_s) return std::nullopt;
  const std::int64_t offset_ns = nanoseconds(offset_s);
  if (offset_ns > 0 ? stamp_ns > Limits::max() - offset_ns : stamp_ns < Limits::min() - offset_ns) return std::nullopt;
  return stamp_ns + offset_ns;
}

AssociatedTrajectories associate_by_interpolation(const Trajectory& reference, const Trajectory& estimate,
                                                  const AssociationSettings& settings) {
  const PoseInterpolator poses(reference);
  const std::int64_t max_gap_ns = nanoseconds(std::min(settings.max_gap_s, kLongest_s));
  AssociatedTrajectories result;
  std::vector<double> differences_s;
  std::unordered_set<std::int64_t> nearest;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const std::optional<std::int64_t> stamp_ns = shifted(estimate.stamps_ns[i], settings.offset_s);
    const auto answer = stamp_ns ? poses.at(*stamp_ns, max_gap_ns) : PoseInterpolator::Answer{};
    if (answer.place == PoseInterpolator::Place::kOutside) ++result.num_extrapolated;
    if (answer.place != PoseInterpolator::Place::kInside) continue;
    result.reference.world_from_scan.push_back(answer.world_from_scan);
    result.reference.stamps_ns.push_back(*stamp_ns);
    result.estimate_indices.push_back(i);
    nearest.insert(answer.nearest_ns);
    differences_s.push_back(std::abs(seconds(*stamp_ns) - seconds(answer.nearest_ns)));
  }
  if (result.estimate_indices.empty()) {
    throw InvalidArgument(
        fmt::format("no time stamp of the estimate ({} poses) lies between two of the reference ({} poses) that are at "
                    "most max_gap_s = {} apart; {} are outside its time",
                    estimate.size(), reference.size(), settings.max_gap_s, result.num_extrapolated));
  }
  result.estimate = subset(estimate, result.estimate_indices);
  result.num_pairs = result.estimate_indices.size();
  result.num_unmatched_estimate = estimate.size() - result.num_pairs;
  result.num_unmatched_reference = reference.size() - std::min(nearest.size(), reference.size());
  result.median_difference_s = median_of_defined(differences_s);
  return result;
}

void check(const Trajectory& trajectory, const char* name) {
  if (trajectory.size() == 0) throw InvalidArgument(fmt::format("the {} has no poses", name));
  if (trajectory.stamps_ns.empty() || trajectory.stamps_ns.size() == trajectory.size()) return;
  throw InvalidArgument(
      fmt::format("the {} has {} poses and {} time stamps", name, trajectory.size(), trajectory.stamps_ns.size()));
}

}  // namespace

void AssociationSettings::validate() const {
  if (!(max_difference_s >= 0 && std::isfinite(max_difference_s))) {
    throw InvalidArgument(fmt::format("max_difference_s = {} is out of range: it must be >= 0", max_difference_s));
  }
  if (!std::isfinite(offset_s)) {
    throw InvalidArgument(fmt::format("offset_s = {} is out of range: it must be finite", offset_s));
  }
  if (!(max_gap_s > 0)) {
    throw InvalidArgument(fmt::format("max_gap_s = {} is out of range: it must be > 0", max_gap_s));
  }
  if (one_to_one && interpolate) throw InvalidArgument("one_to_one and interpolate exclude each other");
}

AssociatedTrajectories associate(const Trajectory& reference, const Trajectory& estimate,
                                 const AssociationSettings& settings) {
  settings.validate();
  check(reference, "reference");
  check(estimate, "estimate");
  if (reference.stamps_ns.empty() || estimate.stamps_ns.empty()) return associate_by_index(reference, estimate);
  if (settings.interpolate) return associate_by_interpolation(reference, estimate, settings);

  std::vector<double> reference_s = seconds(reference.stamps_ns);
  std::vector<double> estimate_s = seconds(estimate.stamps_ns);
  const bool estimate_is_longer = estimate.size() > reference.size();
  // The longer one is shifted, as evo does it: the rounded sums decide between stamps that are equally near.
  for (double& stamp : estimate_is_longer ? estimate_s : reference_s) {
    stamp += estimate_is_longer ? settings.offset_s : -settings.offset_s;
  }
  const std::span<const double> short_s = estimate_is_longer ? reference_s : estimate_s;
  const std::span<const double> long_s = estimate_is_longer ? estimate_s : reference_s;
  Matches matches = match(short_s, long_s, settings.max_difference_s);
  if (settings.one_to_one) keep_nearest_of_each(matches, short_s, long_s);
  if (matches.in_short.empty()) {
    throw InvalidArgument(fmt::format(
        "no time stamp of the estimate ({} poses) is within max_difference_s = {} of one of the reference ({} poses)",
        estimate.size(), settings.max_difference_s, reference.size()));
  }
  const auto& in_reference = estimate_is_longer ? matches.in_short : matches.in_long;
  const auto& in_estimate = estimate_is_longer ? matches.in_long : matches.in_short;
  return {.reference = subset(reference, in_reference),
          .estimate = subset(estimate, in_estimate),
          .estimate_indices = in_estimate,
          .num_pairs = in_reference.size(),
          .num_unmatched_reference = reference.size() - num_distinct(in_reference),
          .num_unmatched_estimate = estimate.size() - num_distinct(in_estimate),
          .median_difference_s = median_difference_s(matches, short_s, long_s)};
}

std::vector<std::optional<std::size_t>> nearest_in_time(std::span<const std::int64_t> queries_ns,
                                                        std::span<const std::int64_t> stamps_ns,
                                                        double max_difference_s) {
  AssociationSettings{.max_difference_s = max_difference_s}.validate();
  return nearest(seconds(queries_ns), seconds(stamps_ns), max_difference_s);
}

}  // namespace trysquare
