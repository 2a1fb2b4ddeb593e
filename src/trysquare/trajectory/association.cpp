// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/association.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace trysquare {
namespace {

/// Keeps offset and difference, in nanoseconds, far from the ends of 64 bits.
constexpr double kLargestTimeS = 4e9;

std::int64_t nanoseconds(double seconds) { return std::llround(seconds * 1e9); }

std::uint64_t distance(std::int64_t a, std::int64_t b) {
  const auto [low, high] = std::minmax(a, b);
  return static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
}

std::vector<std::int64_t> shifted(std::span<const std::int64_t> stamps_ns, std::int64_t offset_ns) {
  std::vector<std::int64_t> result(stamps_ns.begin(), stamps_ns.end());
  for (std::int64_t& stamp : result) {
    const bool overflows = offset_ns > 0 ? stamp > std::numeric_limits<std::int64_t>::max() - offset_ns
                                         : stamp < std::numeric_limits<std::int64_t>::min() - offset_ns;
    if (overflows)
      throw InvalidArgument(fmt::format("time stamp {} ns plus offset_s leaves the range of 64 bits", stamp));
    stamp += offset_ns;
  }
  return result;
}

/// Answers "which stamp is nearest?" in O(log N).
class StampIndex {
 public:
  explicit StampIndex(std::span<const std::int64_t> stamps_ns) : stamps_ns_(stamps_ns), order_(stamps_ns.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return stamps_ns_[a] < stamps_ns_[b]; });
  }

  /// Index of the stamp nearest to `stamp_ns`; the smallest index of those equally near. REQUIRES one stamp or more.
  std::size_t nearest(std::int64_t stamp_ns) const {
    const auto above = first_not_before(stamp_ns);
    if (above == order_.begin()) return *above;
    const std::size_t below = *first_not_before(stamps_ns_[*(above - 1)]);
    if (above == order_.end()) return below;
    const std::uint64_t to_below = distance(stamps_ns_[below], stamp_ns);
    const std::uint64_t to_above = distance(stamps_ns_[*above], stamp_ns);
    if (to_below == to_above) return std::min(below, *above);
    return to_below < to_above ? below : *above;
  }

 private:
  std::vector<std::size_t>::const_iterator first_not_before(std::int64_t stamp_ns) const {
    return std::lower_bound(order_.begin(), order_.end(), stamp_ns,
                            [&](std::size_t index, std::int64_t stamp) { return stamps_ns_[index] < stamp; });
  }

  std::span<const std::int64_t> stamps_ns_;
  std::vector<std::size_t> order_;  ///< Indices in the order of time.
};

struct Matches {
  std::vector<std::size_t> in_short;
  std::vector<std::size_t> in_long;
};

Matches match(std::span<const std::int64_t> short_ns, std::span<const std::int64_t> long_ns,
              std::int64_t max_difference_ns) {
  const StampIndex index(long_ns);
  Matches matches;
  for (std::size_t i = 0; i < short_ns.size(); ++i) {
    const std::size_t j = index.nearest(short_ns[i]);
    if (distance(short_ns[i], long_ns[j]) > static_cast<std::uint64_t>(max_difference_ns)) continue;
    matches.in_short.push_back(i);
    matches.in_long.push_back(j);
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
  return {.reference = reference, .estimate = estimate, .num_pairs = reference.size(), .by_index = true};
}

void check(const Trajectory& trajectory, const char* name) {
  if (trajectory.size() == 0) throw InvalidArgument(fmt::format("the {} has no poses", name));
  if (trajectory.stamps_ns.empty() || trajectory.stamps_ns.size() == trajectory.size()) return;
  throw InvalidArgument(
      fmt::format("the {} has {} poses and {} time stamps", name, trajectory.size(), trajectory.stamps_ns.size()));
}

}  // namespace

void AssociationSettings::validate() const {
  if (!(max_difference_s >= 0 && max_difference_s <= kLargestTimeS)) {
    throw InvalidArgument(
        fmt::format("max_difference_s = {} is out of range: it must be in [0, {}]", max_difference_s, kLargestTimeS));
  }
  if (!(std::abs(offset_s) <= kLargestTimeS)) {
    throw InvalidArgument(
        fmt::format("offset_s = {} is out of range: it must be in [-{}, {}]", offset_s, kLargestTimeS, kLargestTimeS));
  }
}

AssociatedTrajectories associate(const Trajectory& reference, const Trajectory& estimate,
                                 const AssociationSettings& settings) {
  settings.validate();
  check(reference, "reference");
  check(estimate, "estimate");
  if (reference.stamps_ns.empty() || estimate.stamps_ns.empty()) return associate_by_index(reference, estimate);

  const std::vector<std::int64_t> estimate_ns = shifted(estimate.stamps_ns, nanoseconds(settings.offset_s));
  const std::int64_t max_difference_ns = nanoseconds(settings.max_difference_s);
  const bool estimate_is_longer = estimate.size() > reference.size();
  const Matches matches = estimate_is_longer ? match(reference.stamps_ns, estimate_ns, max_difference_ns)
                                             : match(estimate_ns, reference.stamps_ns, max_difference_ns);
  if (matches.in_short.empty()) {
    throw InvalidArgument(fmt::format(
        "no time stamp of the estimate ({} poses) is within max_difference_s = {} of one of the reference ({} poses)",
        estimate.size(), settings.max_difference_s, reference.size()));
  }
  const auto& in_reference = estimate_is_longer ? matches.in_short : matches.in_long;
  const auto& in_estimate = estimate_is_longer ? matches.in_long : matches.in_short;
  return {.reference = subset(reference, in_reference),
          .estimate = subset(estimate, in_estimate),
          .num_pairs = in_reference.size(),
          .num_unmatched_reference = reference.size() - num_distinct(in_reference),
          .num_unmatched_estimate = estimate.size() - num_distinct(in_estimate)};
}

}  // namespace trysquare
