// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

namespace trysquare {

/// Mean of the values that are not NaN; nullopt when there is none. Unit of the input.
std::optional<double> mean_of_defined(std::span<const double> values);

}  // namespace trysquare
