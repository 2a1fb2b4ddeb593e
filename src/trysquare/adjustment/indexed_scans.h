// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/adjustment_settings.h"
#include "trysquare/core/execution.h"
#include "trysquare/core/points.h"
#include "trysquare/core/scan.h"
#include "trysquare/neighborhood/point_index.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace trysquare {

/// N scans, each with an index in its own frame: a trajectory may change, these do not.
///
/// As many scans as fit into `max_points_in_memory` stay in memory; the others are loaded and indexed again by every
/// pass, so memory is bounded whatever the length of the sequence. Refers to `scans`.
class IndexedScans {
 public:
  /// One scan and the index over it, in the frame of the scan [m].
  struct IndexedScan {
    std::vector<Eigen::Vector3d> points_in_scan;
    std::unique_ptr<PointIndex> index;
  };

  /// @param settings  Range limits of the points, and how many stay in memory.
  /// @throws IoError  from ScanSequence::load().
  IndexedScans(const ScanSequence& scans, const AdjustmentSettings& settings, const Execution& execution);

  std::size_t size() const { return scans_.size(); }

  /// Calls visit(scan, indexed) once for each scan, from several threads at once, in no fixed order.
  /// @throws IoError  from ScanSequence::load().
  void for_each(const Execution& execution, std::string_view stage,
                const std::function<void(std::size_t scan, const IndexedScan& indexed)>& visit) const;

 private:
  IndexedScan load(std::size_t scan) const;

  const ScanSequence& scans_;
  double min_range_m_;
  double max_range_m_;
  std::vector<IndexedScan> in_memory_;  ///< Without an index: not in memory.
};

}  // namespace trysquare
