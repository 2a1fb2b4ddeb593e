// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// Defaults are those of KITTI's development kit.
struct KittiDriftSettings {
  std::vector<double> lengths_m = {100, 200, 300, 400, 500, 600, 700, 800};  ///< > 0, ascending.
  std::size_t step = 10;                                                     ///< A segment starts at every n-th pose.

  /// @throws InvalidArgument  if a member is out of range.
  void validate() const;
};

/// Mean errors of segments, per length that was travelled.
struct Drift {
  double translation_percent = 0;
  double rotation_deg_per_100m = 0;
  std::size_t num_segments = 0;
};

/// Drift over all segments, and by their length.
struct KittiDrift {
  /// Of the segments of one length.
  struct OfLength {
    double length_m = 0;
    std::optional<Drift> drift{};  ///< Empty when no segment is that long.
  };
  std::optional<Drift> mean{};        ///< Over all segments of all lengths; empty when there is none.
  std::vector<OfLength> by_length{};  ///< One for each of lengths_m.
  double path_length_m = 0;           ///< Of the reference.
  std::string reason{};               ///< Why `mean` is empty.
};

/// Drift as the KITTI odometry benchmark ranks it. Lower is better.
///
/// From every 10th pose i, for each length L: j is the first pose that is more than L further along the path of the
/// reference; the error of the motion, (est_i⁻¹ est_j)⁻¹ (ref_i⁻¹ ref_j), is divided by L. No alignment: motions need
/// none.
///
/// @param reference, estimate   Pose i belongs to pose i.
/// @throws InvalidArgument  if the counts differ or are 0, a pose is not finite, or the settings are out of range. A
/// path
///                          shorter than the shortest length is a result, and undefined.
///
/// Source:  Geiger, Lenz, Urtasun, Are we ready for autonomous driving?, 2012; the benchmark's development kit.
/// Differs: the angle is taken by atan2, not by an arc cosine, which is off below 1e-8 rad; inverses are rigid
///          (docs/definitions.md#rpe).
/// Cost:    O(N log N)
KittiDrift kitti_drift(const Trajectory& reference, const Trajectory& estimate,
                       const KittiDriftSettings& settings = {});

}  // namespace trysquare
