// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace trysquare {

/// What the distance between the two poses of a pair is measured in.
enum class DeltaUnit { kFrames, kMetres, kDegrees, kRadians };

/// "f", "m", "d", "r", as evo's --delta_unit.
std::string_view name_of(DeltaUnit unit);

/// The unit that name_of() calls `name`; nullopt when there is none.
std::optional<DeltaUnit> delta_unit_named(std::string_view name);

/// Which pairs of poses a relative error looks at. Defaults are evo's.
struct PosePairSettings {
  double delta = 1;  ///< > 0; a whole number for kFrames; at most half a turn for the angles.
  DeltaUnit unit = DeltaUnit::kFrames;
  double relative_tolerance = 0.1;  ///< For all pairs by path or angle: accept delta · (1 ± this). >= 0.
  bool all_pairs = false;           ///< False: consecutive pairs, the end of one is the start of the next.

  /// @throws InvalidArgument  if a member is out of range.
  void validate() const;
};

/// Indices of two poses, first < second.
struct PosePair {
  std::size_t first = 0;
  std::size_t second = 0;

  friend bool operator==(const PosePair&, const PosePair&) = default;
};

/// The pairs (i, j) of poses that are `delta` apart, in ascending order, chosen as evo chooses them:
///
/// | unit    | consecutive                                             | all pairs |
/// |---------|---------------------------------------------------------|------------------------------------------------|
/// | frames  | (0, Δ), (Δ, 2Δ), …                                      | every (i, i + Δ) | | metres  | path since the
/// last end >= Δ; the path up to the first  | for each i the j > i whose path from i is      | |         | end belongs
/// to no pair                                  | nearest to Δ, if within the tolerance          | | angle   | sum of
/// the angles of the steps since the last end >= Δ  | every j > i with an angle between poses i and  | |         | | j,
/// directly, within the tolerance              |
///
/// @throws InvalidArgument  if the settings are out of range. No pair at all is an empty list, not an error.
/// Cost:  O(N); O(N log N) for all pairs by path; O(N²) for all pairs by angle.
std::vector<PosePair> pose_pairs(const Trajectory& trajectory, const PosePairSettings& settings);

}  // namespace trysquare
