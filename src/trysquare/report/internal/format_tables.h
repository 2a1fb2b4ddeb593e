// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/report/internal/json.h"

#include <string>

namespace trysquare::internal {

/// Sections of tables. Empty where there is nothing that was asked for.
std::string html_directions(const Json& evaluation);
std::string html_reference(const Json& evaluation);
std::string html_correlations(const Json& evaluation);
std::string html_inputs(const Json& evaluation);
std::string html_settings(const Json& evaluation);

}  // namespace trysquare::internal
