// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/pose.h"
#include "trysquare/core/trajectory.h"

#include <cstddef>
#include <optional>
#include <string_view>

namespace trysquare {

/// How an estimate is moved onto the reference before the two are compared.
enum class Alignment {
  kNone,
  kOrigin,  ///< The first poses coincide.
  kScale,   ///< Positions are multiplied by the scale of kSim3; no rotation, no translation.
  kSe3,     ///< Rotation and translation, least squares over the positions.
  kSim3,    ///< Rotation, translation and scale, least squares over the positions.
};

/// "none", "origin", "scale", "se3", "sim3".
std::string_view name_of(Alignment alignment);

/// The alignment that name_of() calls `name`; nullopt when there is none.
std::optional<Alignment> alignment_named(std::string_view name);

/// point_in_b = b_from_a.pose * (b_from_a.scale · point_in_a).
struct Similarity {
  Pose pose{};
  double scale = 1;
};

/// The similarity that moves `estimate` onto `reference`, pose i onto pose i.
///
/// @param reference, estimate   Equally many poses, at least one.
/// @param num_poses_to_align    Only the first so many poses decide (kScale, kSe3, kSim3); 0 or too many: all.
/// @return                      reference_from_estimate.
/// @throws InvalidArgument  if the counts differ or are 0, a pose is not finite; for kScale, kSe3, kSim3 also if the
///                          positions do not fix a rotation: fewer than three, or all on one line.
/// Source:  Umeyama, Least-squares estimation of transformation parameters between two point patterns, 1991.
Similarity align(const Trajectory& reference, const Trajectory& estimate, Alignment alignment,
                 std::size_t num_poses_to_align = 0);

/// Every pose of `trajectory` moved: position p becomes b_from_a applied to p, orientation R becomes the rotation of
/// b_from_a times R. Stamps are kept.
Trajectory transformed(const Similarity& b_from_a, const Trajectory& trajectory_in_a);

}  // namespace trysquare
