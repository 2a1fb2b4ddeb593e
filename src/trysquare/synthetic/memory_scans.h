// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/scan.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace trysquare {

/// Scans that are already in memory.
class MemoryScans : public ScanSequence {
 public:
  explicit MemoryScans(std::vector<Scan> scans) : scans_(std::move(scans)) {}

  std::size_t size() const override { return scans_.size(); }
  Scan load(std::size_t index) const override;
  std::string name(std::size_t index) const override;  ///< "scan 3".

 private:
  std::vector<Scan> scans_;
};

}  // namespace trysquare
