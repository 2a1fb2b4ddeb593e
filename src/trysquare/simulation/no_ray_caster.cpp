// SPDX-License-Identifier: Apache-2.0
// In the place of ray_caster.cpp where Embree is left out (TRYSQUARE_RAY_CASTER=OFF), as in the Python wheel.
#include "trysquare/core/error.h"
#include "trysquare/simulation/ray_caster.h"

namespace trysquare {

class RayCaster::Scene {};

RayCaster::RayCaster(const TriangleMesh& /*mesh_in_world*/) {
  throw InvalidArgument(
      "this trysquare was built without its ray caster (TRYSQUARE_RAY_CASTER=OFF, as in the Python wheel) and cannot "
      "simulate scans");
}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

void RayCaster::cast(std::span<const Ray> /*rays*/, double /*max_range_m*/, std::span<double> /*ranges_m*/) const {}

double RayCaster::cast(const Ray& /*ray*/, double /*max_range_m*/) const { return kNoReturn; }

}  // namespace trysquare
