// SPDX-License-Identifier: Apache-2.0
#include "trysquare/mapping/assemble_map.h"

#include "trysquare/core/error.h"
#include "trysquare/parallel/for_each_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

void validate(const ScanSequence& scans, const Trajectory& trajectory, const MapSettings& settings) {
  settings.validate();
  require_pose_per_scan(trajectory, scans.size());
  if (settings.first_scan + settings.num_scans > scans.size()) {
    throw InvalidArgument(fmt::format("scans {} to {} were asked for, but there are {}", settings.first_scan,
                                      settings.first_scan + settings.num_scans - 1, scans.size()));
  }
}

/// One scan, moved and thinned.
struct MovedScan {
  std::vector<Eigen::Vector3d> points_in_map;
  std::size_t num_not_finite = 0;
  std::size_t num_at_origin = 0;
  std::size_t num_out_of_range = 0;
};

MovedScan move_scan(const Scan& scan, const Pose& map_from_scan, const MapSettings& settings) {
  MovedScan moved{.num_not_finite = scan.num_not_finite, .num_at_origin = scan.num_at_origin};
  moved.points_in_map.reserve(scan.points_in_scan.size() / settings.keep_every + 1);
  for (std::size_t i = 0; i < scan.points_in_scan.size(); i += settings.keep_every) {
    const Eigen::Vector3d& point = scan.points_in_scan[i];
    const double range_m = point.norm();
    if (range_m < settings.min_range_m || range_m > settings.max_range_m) {
      ++moved.num_out_of_range;
    } else {
      moved.points_in_map.push_back(map_from_scan * point);
    }
  }
  return moved;
}

void append(AssembledMap& assembled, MovedScan&& moved, std::uint32_t scan_index) {
  RegisteredMap& map = assembled.map;
  map.points_in_map.insert(map.points_in_map.end(), moved.points_in_map.begin(), moved.points_in_map.end());
  map.scan_of_point.resize(map.points_in_map.size(), scan_index);
  assembled.num_not_finite += moved.num_not_finite;
  assembled.num_at_origin += moved.num_at_origin;
  assembled.num_out_of_range += moved.num_out_of_range;
  moved = {};
}

}  // namespace

void MapSettings::validate() const {
  if (keep_every < 1) throw InvalidArgument("keep_every = 0 is out of range: it must be at least 1");
  if (!(min_range_m >= 0)) {
    throw InvalidArgument(fmt::format("min_range_m = {} is out of range: it must be >= 0", min_range_m));
  }
  if (!(max_range_m > min_range_m)) {
    throw InvalidArgument(
        fmt::format("max_range_m = {} is out of range: it must be above min_range_m = {}", max_range_m, min_range_m));
  }
}

AssembledMap assemble_map(const ScanSequence& scans, const Trajectory& trajectory, const MapSettings& settings,
                          const Execution& execution) {
  validate(scans, trajectory, settings);
  AssembledMap assembled;
  const std::size_t first = settings.first_scan;
  const std::size_t count = settings.num_scans == 0 ? scans.size() - first : settings.num_scans;
  assembled.map.num_scans = count;
  if (count == 0) return assembled;
  assembled.map.world_from_map = trajectory.world_from_scan[first];
  const Pose map_from_world = general_inverse(assembled.map.world_from_map);

  std::vector<MovedScan> moved(count);
  for_each_block(count, 1, execution, "scans", [&](const Block& block) {
    const std::size_t scan = first + block.index;
    moved[block.index] = move_scan(scans.load(scan), map_from_world * trajectory.world_from_scan[scan], settings);
  });
  std::size_t num_points = 0;
  for (const MovedScan& scan : moved) num_points += scan.points_in_map.size();
  assembled.map.points_in_map.reserve(num_points);
  assembled.map.scan_of_point.reserve(num_points);
  for (std::size_t i = 0; i < count; ++i) append(assembled, std::move(moved[i]), static_cast<std::uint32_t>(i));
  return assembled;
}

}  // namespace trysquare
