// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/execution.h"

#include "trysquare/core/error.h"

namespace trysquare {

void Execution::validate() const {
  constexpr int kMost = 1024;  // far beyond that, TBB does not survive
  if (num_threads < 0 || num_threads > kMost) {
    throw InvalidArgument("num_threads = " + std::to_string(num_threads) +
                          " is out of range: it must be 0 (all cores) to " + std::to_string(kMost));
  }
}

}  // namespace trysquare
