// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/pipeline/compare.h"

#include <string>

namespace trysquare::app {

/// What a comparison found, for people: a row per trajectory, best first, and a sentence per pair.
std::string comparison_table(const Comparison& comparison, bool color);

}  // namespace trysquare::app
