// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace trysquare {

/// Which number is taken of a pose error E = (R, t). Spelled on the command line as evo spells it, see name_of().
enum class PoseRelation {
  kFull,                     ///< Frobenius norm of E − I, 4×4: metres and rotation mixed, no unit.
  kTranslationPart,          ///< ‖t‖ [m].
  kRotationPart,             ///< Frobenius norm of R − I, 3×3, no unit.
  kRotationAngleDeg,         ///< Angle of R [deg].
  kRotationAngleRad,         ///< Angle of R [rad].
  kPointDistance,            ///< APE: as kTranslationPart. RPE: difference of the two distances between the poses [m].
  kPointDistanceErrorRatio,  ///< RPE only: that difference over the distance in the reference [%].
};

/// "full", "trans_part", "rot_part", "angle_deg", "angle_rad", "point_distance", "point_distance_error_ratio".
std::string_view name_of(PoseRelation relation);

/// "m", "deg", "rad", "%", or "unit-less".
std::string_view unit_of(PoseRelation relation);

/// The relation that name_of() calls `name`; nullopt when there is none.
std::optional<PoseRelation> pose_relation_named(std::string_view name);

}  // namespace trysquare
