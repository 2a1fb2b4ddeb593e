// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/stats/error_statistics.h"

#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// Which sub-trajectories relative errors are taken over.
struct ErrorByLengthSettings {
  std::vector<double> lengths_m{};                         ///< Each > 0; empty: shares of the path.
  std::vector<double> shares = {0.1, 0.2, 0.3, 0.4, 0.5};  ///< Of the path length of the reference, each in (0, 1].
  double relative_tolerance = 0.2;  ///< A sub-trajectory may be that much longer or shorter, >= 0.

  /// @throws InvalidArgument  if a member is out of range.
  void validate() const;
};

/// Errors of all sub-trajectories of one length.
struct ErrorOfLength {
  double length_m = 0;
  std::optional<ErrorStatistics> translation_m{};  ///< Empty when no sub-trajectory has this length.
  std::optional<ErrorStatistics> translation_percent{};
  std::optional<ErrorStatistics> rotation_rad{};
  std::string reason{};  ///< Why they are empty.
};

/// Relative error by the length of the trajectory: for each length and each pose i, the pose whose path from i on the
/// reference is nearest to it, and the error of the motion between both, as in rpe(). Drift that does not grow in
/// proportion to the path shows as percentages that fall or rise.
///
/// @param reference, estimate   Pose i belongs to pose i.
/// @throws InvalidArgument  if the counts differ or are 0, a pose is not finite, the reference does not move, or the
///                          settings are out of range.
///
/// Source: Zhang & Scaramuzza, A tutorial on quantitative trajectory evaluation for visual(-inertial) odometry, 2018.
/// Cost:   O(N log N) per length.
std::vector<ErrorOfLength> error_by_length(const Trajectory& reference, const Trajectory& estimate,
                                           const ErrorByLengthSettings& settings = {});

}  // namespace trysquare
