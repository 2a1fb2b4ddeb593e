// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/diagnostic.h"
#include "trysquare/core/trajectory.h"

#include <Eigen/Core>

#include <optional>

namespace trysquare {

/// Axes that fit better than the given ones, and how well: cosines between what both trajectories say of the same
/// motions, as vectors of all motions together. 1: the same directions; neither size nor scale matter.
struct RenamedAxes {
  Eigen::Matrix3d reference_from_estimate = Eigen::Matrix3d::Identity();  ///< Entries 0, 1 and −1, right-handed.
  double translation_cosine = 0;        ///< Of the translations, with the axes renamed.
  double rotation_cosine = 0;           ///< Of the rotation vectors, likewise.
  double given_translation_cosine = 0;  ///< As given.
  double given_rotation_cosine = 0;     ///< As given.
};

/// Whether the poses of both are of frames whose axes have other names: one of a camera (x right, y down, z forward),
/// the other of a body (x forward, y left, z up). Aligned APE hardly sees that, RPE sees nothing else.
///
/// The motions of both are compared with the axes of the estimate's frame as given and in the 23 other right-handed
/// ways. Said is only what leaves no doubt: with other axes both cosines are 0.8 or more, as given one of them is 0.5
/// or less. Where nothing turns (or moves), that cosine decides nothing and counts as 1. Frames that differ by less
/// than about 45° are left alone, and so is an estimate that is merely bad: no axes fit it. Where a sensor sits on its
/// body does not matter for the rotations, and little for the translations.
///
/// @param reference, estimate  Pose i belongs to pose i; the worlds and the scale may differ.
/// @return                     Nothing, too, when there are fewer than ten motions.
/// @throws InvalidArgument     if the counts differ or are 0, or a pose is not finite.
/// Cost:   O(1): at most about 400 motions are looked at, from one end of the run to the other.
std::optional<RenamedAxes> renamed_axes(const Trajectory& reference, const Trajectory& estimate);

/// The same as a warning ("renamed_axes") that says which axes, how well they fit and which extrinsic mends it.
std::optional<Diagnostic> check_axes(const Trajectory& reference, const Trajectory& estimate);

}  // namespace trysquare
