// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/indexed_scans.h"

#include "trysquare/parallel/for_each_block.h"

#include <algorithm>
#include <utility>

namespace trysquare {

IndexedScans::IndexedScans(const ScanSequence& scans, const AdjustmentSettings& settings, const Execution& execution)
    : scans_(scans), min_range_m_(settings.min_range_m), max_range_m_(settings.max_range_m), in_memory_(scans.size()) {
  // Groups of scans are kept until the memory is full: which scans stay depends on their sizes only.
  constexpr std::size_t kGroup = 16;
  std::size_t num_points = 0;
  for (std::size_t begin = 0; begin < scans.size() && num_points < settings.max_points_in_memory; begin += kGroup) {
    const std::size_t count = std::min(kGroup, scans.size() - begin);
    const Execution silent{.num_threads = execution.num_threads};
    for_each_block(count, 1, silent, "scans",
                   [&](const Block& block) { in_memory_[begin + block.index] = load(begin + block.index); });
    for (std::size_t i = begin; i < begin + count; ++i) num_points += in_memory_[i].points_in_scan.size();
    if (execution.progress) execution.progress("scans", begin + count, scans.size());
  }
}

IndexedScans::IndexedScan IndexedScans::load(std::size_t scan) const {
  IndexedScan result{.points_in_scan = scans_.load(scan).points_in_scan};
  std::erase_if(result.points_in_scan, [&](const Eigen::Vector3d& point) {
    const double range_m = point.norm();
    return range_m < min_range_m_ || range_m > max_range_m_;
  });
  result.index = std::make_unique<PointIndex>(result.points_in_scan, Execution{.num_threads = 1});
  return result;
}

void IndexedScans::for_each(const Execution& execution, std::string_view stage,
                            const std::function<void(std::size_t, const IndexedScan&)>& visit) const {
  for_each_block(size(), 1, execution, stage, [&](const Block& block) {
    const IndexedScan& kept = in_memory_[block.index];
    if (kept.index) {
      visit(block.index, kept);
    } else {
      visit(block.index, load(block.index));
    }
  });
}

}  // namespace trysquare
