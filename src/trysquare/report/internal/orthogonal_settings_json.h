// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/extract_orthogonal_subset.h"
#include "trysquare/report/internal/json.h"

namespace trysquare::internal {

Json orthogonal_settings_json(const OrthogonalSubsetSettings& settings);

}  // namespace trysquare::internal
