// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/memory_scans.h"

#include "trysquare/core/error.h"

namespace trysquare {

Scan MemoryScans::load(std::size_t index) const {
  if (index < scans_.size()) return scans_[index];
  throw InvalidArgument("index = " + std::to_string(index) + " is out of range: there are " +
                        std::to_string(scans_.size()) + " scans");
}

std::string MemoryScans::name(std::size_t index) const { return "scan " + std::to_string(index); }

}  // namespace trysquare
