// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/error_unit.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace trysquare {
namespace {

struct Unit {
  std::string_view name;
  bool is_length;
  double in_base;  ///< One of it, in metres or radians.
};

constexpr std::array<Unit, 6> kUnits{{{"mm", true, 1e-3},
                                      {"cm", true, 1e-2},
                                      {"m", true, 1},
                                      {"km", true, 1e3},
                                      {"deg", false, std::numbers::pi / 180},
                                      {"rad", false, 1}}};

const Unit* find_unit(std::string_view name) {
  const auto* found = std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& unit) { return unit.name == name; });
  return found == kUnits.end() ? nullptr : found;
}

}  // namespace

std::string_view unit_of(const TrajectoryErrors& errors) {
  return errors.unit.empty() ? unit_of(errors.relation) : errors.unit;
}

void change_unit(TrajectoryErrors& errors, std::string_view unit) {
  const Unit* to = find_unit(unit);
  if (to == nullptr) throw InvalidArgument(fmt::format("unit = {}: it must be mm, cm, m, km, deg or rad", unit));
  const Unit* from = find_unit(unit_of(errors));
  if (from == nullptr || from->is_length != to->is_length) {
    throw InvalidArgument(
        fmt::format("errors of {} in {} cannot be changed to {}", name_of(errors.relation), unit_of(errors), unit));
  }
  if (from == to) return;
  const double factor = from->in_base / to->in_base;
  for (double& error : errors.errors) error *= factor;
  errors.statistics = error_statistics(errors.errors);
  errors.unit = to->name;
}

}  // namespace trysquare
