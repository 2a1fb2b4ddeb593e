// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

namespace trysquare {

/// Median of the values that are not NaN (mean of the middle two for an even count); nullopt when there is none.
std::optional<double> median_of_defined(std::span<const double> values);

}  // namespace trysquare
