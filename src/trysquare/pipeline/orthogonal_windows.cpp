// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/orthogonal_windows.h"

#include "trysquare/core/error.h"
#include "trysquare/mapping/assemble_map.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trysquare {
namespace {

/// A direction has no sign.
double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

std::optional<double> angle_to_nearest(const Eigen::Vector3d& normal,
                                       const std::vector<OrthogonalWindow::Direction>& others) {
  double nearest = std::numbers::pi / 4;
  bool is_found = false;
  for (const OrthogonalWindow::Direction& other : others) {
    const double angle = angle_between(normal, other.normal_in_map);
    if (angle >= nearest) continue;
    nearest = angle;
    is_found = true;
  }
  return is_found ? std::optional(nearest) : std::nullopt;
}

OrthogonalWindow window_at(std::size_t first, std::size_t count, const ScanSequence& scans,
                           const Trajectory& trajectory, double radius_m, const OrthogonalSubsetSettings& settings,
                           const Execution& execution) {
  const RegisteredMap map = assemble_map(scans, trajectory, {.first_scan = first, .num_scans = count}, execution).map;
  OrthogonalSubsetResult found = extract_orthogonal_subset(map, radius_m, settings, execution);
  const Pose map_from_window = general_inverse(trajectory.world_from_scan[0]) * trajectory.world_from_scan[first];
  OrthogonalWindow window{.first = first,
                          .last = first + count - 1,
                          .reason = std::move(found.reason),
                          .num_points = found.num_points,
                          .num_planar = found.num_planar};
  for (const OrthogonalSubset::Direction& direction : found.subset.directions) {
    window.directions.push_back({.normal_in_map = (map_from_window.rotation * direction.normal_in_map).normalized(),
                                 .num_points = direction.points_in_map.size()});
  }
  return window;
}

void require_at_least_one(const char* name, std::size_t value) {
  if (value < 1) throw InvalidArgument(fmt::format("{} = {} is out of range: it must be at least 1", name, value));
}

}  // namespace

std::vector<OrthogonalWindow> orthogonal_windows(const ScanSequence& scans, const Trajectory& trajectory,
                                                 std::size_t window, std::size_t stride, double radius_m,
                                                 const OrthogonalSubsetSettings& settings, const Execution& execution) {
  require_at_least_one("window", window);
  require_at_least_one("stride", stride);
  if (scans.size() != trajectory.size()) {
    throw InvalidArgument(
        fmt::format("{} scans, but {} poses: there must be one for each", scans.size(), trajectory.size()));
  }
  const std::size_t count = scans.size() < window ? 0 : (scans.size() - window) / stride + 1;
  const Execution quiet{.num_threads = execution.num_threads};
  std::vector<OrthogonalWindow> windows;
  for (std::size_t i = 0; i < count; ++i) {
    if (execution.progress) execution.progress("windows", i, count);
    windows.push_back(window_at(i * stride, window, scans, trajectory, radius_m, settings, quiet));
    if (i == 0) continue;
    for (OrthogonalWindow::Direction& direction : windows[i].directions) {
      direction.moved_rad = angle_to_nearest(direction.normal_in_map, windows[i - 1].directions);
    }
  }
  if (execution.progress) execution.progress("windows", count, count);
  return windows;
}

std::optional<double> largest_move_rad(const std::vector<OrthogonalWindow>& windows) {
  std::optional<double> largest;
  for (const OrthogonalWindow& window : windows) {
    for (const OrthogonalWindow::Direction& direction : window.directions) {
      if (direction.moved_rad) largest = std::max(largest.value_or(0), *direction.moved_rad);
    }
  }
  return largest;
}

}  // namespace trysquare
