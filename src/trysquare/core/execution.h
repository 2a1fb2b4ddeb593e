// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

namespace trysquare {

/// Hears how far a long call is: `done` of `total` units of `stage` ("neighborhoods", "scans", ...). Called from worker
/// threads, one call at a time; must not throw.
using ProgressCallback = std::function<void(std::string_view stage, std::size_t done, std::size_t total)>;

/// How much of the machine one call may use, and whom it tells how far it is. Results depend on neither.
struct Execution {
  int num_threads = 0;        ///< At most so many, and no more than cores; 0: every core; 1: the calling thread.
  ProgressCallback progress;  ///< Optional.

  /// @throws InvalidArgument  if num_threads is negative or more than 1024.
  void validate() const;
};

}  // namespace trysquare
