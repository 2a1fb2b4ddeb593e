// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

namespace trysquare::bench {

/// Time that one phase took.
struct Elapsed {
  double user_s = 0;    ///< User time of the process, summed over its threads.
  double system_s = 0;  ///< Mostly page faults: memory that is touched for the first time.
  double wall_s = 0;
};

/// Runs from its construction on.
class Stopwatch {
 public:
  Stopwatch();
  Elapsed elapsed() const;

 private:
  Elapsed start_;
  std::chrono::steady_clock::time_point start_time_;
};

/// Memory of this process that is resident now, and the most that ever was [bytes]; 0 where the system does not say.
std::uint64_t resident_bytes();
std::uint64_t peak_resident_bytes();

}  // namespace trysquare::bench
