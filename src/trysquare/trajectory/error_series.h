// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/trajectory/projection.h"
#include "trysquare/trajectory/trajectory_errors.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace trysquare {

/// When and where each error happened: at its pose (APE), or at the second pose of its pair (RPE). As evo stores it.
struct ErrorSeries {
  std::vector<double> stamps_s{};               ///< Of the estimate; empty without time stamps.
  std::vector<double> seconds_from_start{};     ///< Since the first pose of the estimate; empty without time stamps.
  std::vector<double> reference_distances_m{};  ///< Along the reference, from pose to pose of the series.
  std::vector<double> estimate_distances_m{};   ///< Along the aligned estimate.
  std::vector<Eigen::Vector3d> positions_in_reference_world{};  ///< Of the aligned estimate.
};

/// The poses that the errors belong to, as they were compared: the estimate aligned, both projected. Of RPE pose 0
/// comes first, where the run begins, and then the second pose of each pair. As evo stores them.
struct ComparedTrajectories {
  Trajectory reference{};
  Trajectory estimate{};  ///< In the world of the reference.
};

/// @param errors      Of ape() or rpe() of these trajectories.
/// @param projection  As in their settings.
ComparedTrajectories compared_trajectories(const TrajectoryErrors& errors, const Trajectory& reference,
                                           const Trajectory& estimate, std::optional<Plane> projection = {});

/// @param errors, projection  As above.
ErrorSeries error_series(const TrajectoryErrors& errors, const Trajectory& reference, const Trajectory& estimate,
                         std::optional<Plane> projection = {});

}  // namespace trysquare
