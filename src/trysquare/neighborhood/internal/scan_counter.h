// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trysquare {

/// Counts distinct scans without a set that must be cleared: a scan was seen by this neighborhood if its mark says so.
class ScanCounter {
 public:
  explicit ScanCounter(std::size_t num_scans) : last_neighborhood_(num_scans, 0) {}

  void start_neighborhood() {
    ++neighborhood_;
    count_ = 0;
  }
  void add(std::uint32_t scan) {
    if (last_neighborhood_[scan] == neighborhood_) return;
    last_neighborhood_[scan] = neighborhood_;
    ++count_;
  }
  std::uint32_t count() const { return count_; }

 private:
  std::vector<std::uint64_t> last_neighborhood_;
  std::uint64_t neighborhood_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace trysquare
