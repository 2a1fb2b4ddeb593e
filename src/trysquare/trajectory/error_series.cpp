// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/error_series.h"

#include "trysquare/trajectory/internal/path_length.h"

#include <cstddef>
#include <cstdint>
#include <numeric>

namespace trysquare {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

/// The double next to the time, whole seconds and the rest apart.
double seconds(std::int64_t stamp_ns) {
  return static_cast<double>(stamp_ns / kNanosecondsPerSecond) +
         static_cast<double>(stamp_ns % kNanosecondsPerSecond) / static_cast<double>(kNanosecondsPerSecond);
}

Trajectory poses_at(const std::vector<std::size_t>& indices, const Trajectory& trajectory) {
  Trajectory some;
  some.world_from_scan.reserve(indices.size());
  for (const std::size_t i : indices) {
    some.world_from_scan.push_back(trajectory.world_from_scan[i]);
    if (!trajectory.stamps_ns.empty()) some.stamps_ns.push_back(trajectory.stamps_ns[i]);
  }
  return some;
}

/// All poses, as the errors were taken of them.
ComparedTrajectories aligned_and_projected(const TrajectoryErrors& errors, const Trajectory& reference,
                                           const Trajectory& estimate, std::optional<Plane> projection) {
  ComparedTrajectories result{reference, transformed(errors.reference_from_estimate, estimate)};
  if (projection) result = {projected(result.reference, *projection), projected(result.estimate, *projection)};
  return result;
}

/// The poses of the series; of RPE pose 0 before them, where paths and times begin, but which has no error.
std::vector<std::size_t> indices_of(const TrajectoryErrors& errors) {
  std::vector<std::size_t> indices;
  if (errors.pairs.empty()) {
    indices.resize(errors.errors.size());
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    return indices;
  }
  indices.push_back(0);
  for (const PosePair& pair : errors.pairs) indices.push_back(pair.second);
  return indices;
}

template <class T>
void drop_first(std::vector<T>& values) {
  if (!values.empty()) values.erase(values.begin());
}

}  // namespace

ComparedTrajectories compared_trajectories(const TrajectoryErrors& errors, const Trajectory& reference,
                                           const Trajectory& estimate, std::optional<Plane> projection) {
  const ComparedTrajectories all = aligned_and_projected(errors, reference, estimate, projection);
  const std::vector<std::size_t> indices = indices_of(errors);
  return {poses_at(indices, all.reference), poses_at(indices, all.estimate)};
}

ErrorSeries error_series(const TrajectoryErrors& errors, const Trajectory& reference, const Trajectory& estimate,
                         std::optional<Plane> projection) {
  const auto [truth, aligned] = aligned_and_projected(errors, reference, estimate, projection);
  const std::vector<std::size_t> indices = indices_of(errors);
  ErrorSeries series{.reference_distances_m = internal::path_lengths(poses_at(indices, truth)),
                     .estimate_distances_m = internal::path_lengths(poses_at(indices, aligned))};
  for (const std::size_t i : indices) {
    series.positions_in_reference_world.push_back(aligned.world_from_scan[i].translation);
    if (!estimate.stamps_ns.empty()) series.stamps_s.push_back(seconds(estimate.stamps_ns[i]));
  }
  for (const double stamp_s : series.stamps_s) series.seconds_from_start.push_back(stamp_s - series.stamps_s.front());
  if (errors.pairs.empty()) return series;
  drop_first(series.stamps_s);
  drop_first(series.seconds_from_start);
  drop_first(series.reference_distances_m);
  drop_first(series.estimate_distances_m);
  drop_first(series.positions_in_reference_world);
  return series;
}

}  // namespace trysquare
