// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/report/internal/json.h"

#include <string>

namespace trysquare::internal {

/// Is the evaluation meaningful, and if not, why not.
std::string html_verdict(const Json& evaluation);

/// The headline numbers: metrics, overlap, errors against a reference, the estimate of the RPE.
std::string html_headline(const Json& evaluation);

std::string html_warnings(const Json& evaluation);

}  // namespace trysquare::internal
