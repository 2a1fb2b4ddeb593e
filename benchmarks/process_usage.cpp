// SPDX-License-Identifier: Apache-2.0
#include "process_usage.h"

#include <sys/resource.h>
#include <sys/time.h>

#include <fstream>
#include <string>
#include <string_view>

namespace trysquare::bench {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

Elapsed usage_so_far() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return {.user_s = seconds(usage.ru_utime), .system_s = seconds(usage.ru_stime)};
}

std::uint64_t bytes_in_status(std::string_view field) {
  std::ifstream status("/proc/self/status");
  std::string name;
  while (status >> name) {
    std::uint64_t kibibytes = 0;
    if (name == field && status >> kibibytes) return 1024 * kibibytes;
    std::getline(status, name);
  }
  return 0;
}

}  // namespace

Stopwatch::Stopwatch() : start_(usage_so_far()), start_time_(std::chrono::steady_clock::now()) {}

Elapsed Stopwatch::elapsed() const {
  const Elapsed now = usage_so_far();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_time_;
  return {now.user_s - start_.user_s, now.system_s - start_.system_s, wall.count()};
}

std::uint64_t resident_bytes() { return bytes_in_status("VmRSS:"); }
std::uint64_t peak_resident_bytes() { return bytes_in_status("VmHWM:"); }

}  // namespace trysquare::bench
