// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"

#include <optional>
#include <string_view>

namespace trysquare {

/// A plane of the world's axes.
enum class Plane { kXy, kXz, kYz };

/// "xy", "xz", "yz".
std::string_view name_of(Plane plane);

/// The plane that name_of() calls `name`; nullopt when there is none.
std::optional<Plane> plane_named(std::string_view name);

/// Poses flattened onto a plane through the world's origin: the coordinate along its normal becomes 0, and the rotation
/// one about the normal alone, by that angle of the roll, pitch, yaw (Rz·Ry·Rx) that belongs to the normal. As evo
/// does.
Trajectory projected(const Trajectory& trajectory, Plane plane);

}  // namespace trysquare
