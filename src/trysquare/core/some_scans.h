// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace trysquare {

/// Some scans of a sequence, which must outlive this.
class SomeScans : public ScanSequence {
 public:
  /// @param which  Indices < all.size().
  SomeScans(const ScanSequence& all, std::vector<std::size_t> which) : all_(all), which_(std::move(which)) {}

  std::size_t size() const override { return which_.size(); }
  Scan load(std::size_t index) const override { return all_.load(which_.at(index)); }
  std::string name(std::size_t index) const override { return all_.name(which_.at(index)); }

 private:
  const ScanSequence& all_;
  std::vector<std::size_t> which_;
};

/// The poses of those scans, with their stamps.
/// @param which  Indices < trajectory.size().
Trajectory take(const Trajectory& trajectory, const std::vector<std::size_t>& which);

}  // namespace trysquare
