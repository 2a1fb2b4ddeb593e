// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trysquare {

/// Which poses of two trajectories belong together.
struct AssociationSettings {
  double max_difference_s = 0.01;  ///< Largest difference of two time stamps of a pair [s], inclusive, >= 0.
  double offset_s = 0;             ///< Added to the time stamps of the estimate before they are compared [s].
  bool one_to_one = false;         ///< A pose that is nearest to several is paired with the nearest of them only.
  bool interpolate = false;        ///< The reference is interpolated to the time stamps of the estimate.
  double max_gap_s = 1;            ///< With `interpolate`: no pose between poses further apart than this [s], > 0.

  /// @throws InvalidArgument  if a member is not finite or out of range.
  void validate() const;
};

/// Two trajectories of the same size whose poses belong together, and what did not find a partner.
struct AssociatedTrajectories {
  Trajectory reference{};
  Trajectory estimate{};                        ///< Its own time stamps, without the offset.
  std::vector<std::size_t> estimate_indices{};  ///< Which poses of the estimate these are.
  std::size_t num_pairs = 0;
  std::size_t num_unmatched_reference = 0;  ///< Reference poses in no pair.
  std::size_t num_unmatched_estimate = 0;   ///< Estimated poses in no pair.
  std::size_t num_extrapolated = 0;  ///< Of the latter: those outside the time of the reference, when interpolating.
  std::optional<double> median_difference_s{};  ///< Median |Δt| of the pairs; with interpolation to the nearest pose.
  bool by_index = false;  ///< True when a trajectory has no time stamps: pose i belongs to pose i.
};

/// Pairs each pose of the shorter trajectory (the estimate when they are equally long) with the pose of the longer one
/// that is nearest in time, as evo does: a pose of the longer one may serve twice, unless `one_to_one`. Stamps need not
/// be sorted; of two that are equally near the earlier index wins. Without stamps in one of them, poses are paired by
/// index.
///
/// With `interpolate` every pose of the estimate meets the pose that the reference had at that very time, between its
/// two neighbors (see interpolated()); nothing is extrapolated, no gap longer than max_gap_s is crossed, and
/// max_difference_s plays no role. Times are nanoseconds in 64 bits there.
///
/// Stamps are compared as evo compares them, as seconds in doubles, which are 2e-7 s apart today: a stamp in the middle
/// of two others falls to the side to which it is rounded (one pose of TUM fr2_desk does).
///
/// @throws InvalidArgument  if a trajectory is empty; if one has no stamps and the counts differ (both are named); if
///                          nothing pairs.
/// Cost:  O((N + M) log N)
AssociatedTrajectories associate(const Trajectory& reference, const Trajectory& estimate,
                                 const AssociationSettings& settings = {});

/// For each query the index of the stamp that is nearest in time, compared as associate() does; the smallest of those
/// equally near, and nothing where none is within `max_difference_s`. Several queries may get the same stamp.
/// @throws InvalidArgument  if max_difference_s is negative or not finite.
/// Cost:  O((N + M) log N) for N stamps and M queries, sorted or not.
std::vector<std::optional<std::size_t>> nearest_in_time(std::span<const std::int64_t> queries_ns,
                                                        std::span<const std::int64_t> stamps_ns,
                                                        double max_difference_s);

}  // namespace trysquare
