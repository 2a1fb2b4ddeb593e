// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/execution.h"

#include "trysquare/core/error.h"

namespace trysquare {

void Execution::validate() const {
  if (num_threads < 0) {
    throw InvalidArgument("num_threads = " + std::to_string(num_threads) +
                          " is out of range: it must be >= 0 (0: all cores)");
  }
}

}  // namespace trysquare
