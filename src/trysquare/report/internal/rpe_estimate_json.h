// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/rpe_estimate.h"
#include "trysquare/report/internal/json.h"

namespace trysquare::internal {

/// The object `rpe_estimate` of an evaluation: metres and degrees; what does not exist is null with `<key>_reason` beside it.
Json rpe_estimate_json(const RpeEstimate& estimate);

/// The settings that matter for the estimate [m].
Json adjustment_settings_json(const AdjustmentSettings& settings);

}  // namespace trysquare::internal
