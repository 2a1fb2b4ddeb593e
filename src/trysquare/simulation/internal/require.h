// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/error.h"

#include <string>

namespace trysquare::internal {

/// @throws InvalidArgument  unless `in_range`.
inline void require(bool in_range, const char* name, double value, const char* range) {
  if (in_range) return;
  throw InvalidArgument(std::string(name) + " = " + std::to_string(value) + " is out of range: it must be " + range);
}

}  // namespace trysquare::internal
