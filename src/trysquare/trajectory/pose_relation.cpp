// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/pose_relation.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace trysquare {
namespace {

struct Entry {
  PoseRelation relation;
  std::string_view name;
  std::string_view unit;
};

/// In the order of the enumerators.
constexpr std::array<Entry, 7> kRelations{{
    {PoseRelation::kFull, "full", "unit-less"},
    {PoseRelation::kTranslationPart, "trans_part", "m"},
    {PoseRelation::kRotationPart, "rot_part", "unit-less"},
    {PoseRelation::kRotationAngleDeg, "angle_deg", "deg"},
    {PoseRelation::kRotationAngleRad, "angle_rad", "rad"},
    {PoseRelation::kPointDistance, "point_distance", "m"},
    {PoseRelation::kPointDistanceErrorRatio, "point_distance_error_ratio", "%"},
}};

}  // namespace

std::string_view name_of(PoseRelation relation) { return kRelations[static_cast<std::size_t>(relation)].name; }

std::string_view unit_of(PoseRelation relation) { return kRelations[static_cast<std::size_t>(relation)].unit; }

std::optional<PoseRelation> pose_relation_named(std::string_view name) {
  const auto* found =
      std::find_if(kRelations.begin(), kRelations.end(), [&](const Entry& e) { return e.name == name; });
  if (found == kRelations.end()) return std::nullopt;
  return found->relation;
}

}  // namespace trysquare
