// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/adjustment_settings.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

namespace trysquare {
namespace {

void require(bool in_range, const char* name, double value, const char* range) {
  if (!in_range) {
    throw InvalidArgument(fmt::format("adjustment: {} = {} is out of range: it must be {}", name, value, range));
  }
}

void require_positive(const char* name, double value) {
  require(value > 0 && value < std::numeric_limits<double>::infinity(), name, value, "positive and finite");
}

void require_at_least(const char* name, std::size_t value, std::size_t least) {
  require(value >= least, name, static_cast<double>(value), fmt::format("at least {}", least).c_str());
}

}  // namespace

AdjustmentSettings AdjustmentSettings::room_scale() {
  return {.patch_radius_m = 0.12,
          .patch_spacing_m = 0.2,
          .max_thickness_m = 0.016,
          .min_patch_range_m = 0.2,
          .max_patch_range_m = 8,
          .max_observation_range_m = 12,
          .widest_half_height_m = 0.2,
          .narrowest_half_height_m = 0.04,
          .checkerboard_m = 0.8,
          .covariance_block_m = 1.6};
}

void AdjustmentSettings::validate() const {
  require_positive("patch_radius_m", patch_radius_m);
  require_positive("patch_spacing_m", patch_spacing_m);
  require_positive("max_thickness_m", max_thickness_m);
  require_positive("planarity_ratio", planarity_ratio);
  require(min_patch_range_m >= 0, "min_patch_range_m", min_patch_range_m, "0 or more");
  require(max_patch_range_m > min_patch_range_m, "max_patch_range_m", max_patch_range_m,
          "greater than min_patch_range_m");
  require_at_least("scans_per_source", scans_per_source, 1);
  require_at_least("max_patches_per_source", max_patches_per_source, 1);
  require_positive("max_observation_range_m", max_observation_range_m);
  require_at_least("max_observers", max_observers, 3);
  require_positive("narrowest_half_height_m", narrowest_half_height_m);
  require(widest_half_height_m >= narrowest_half_height_m, "widest_half_height_m", widest_half_height_m,
          "at least narrowest_half_height_m");
  require_at_least("max_iterations", max_iterations, 2);
  require_positive("checkerboard_m", checkerboard_m);
  require_positive("covariance_block_m", covariance_block_m);
  require(min_range_m >= 0, "min_range_m", min_range_m, "0 or more");
  require(max_range_m > min_range_m, "max_range_m", max_range_m, "greater than min_range_m");
}

}  // namespace trysquare
