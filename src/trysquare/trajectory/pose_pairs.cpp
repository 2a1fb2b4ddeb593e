// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/pose_pairs.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/internal/path_length.h"
#include "trysquare/trajectory/rotation_angle.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace trysquare {
namespace {

constexpr std::array<std::pair<DeltaUnit, std::string_view>, 4> kUnits{{
    {DeltaUnit::kFrames, "f"},
    {DeltaUnit::kMetres, "m"},
    {DeltaUnit::kDegrees, "d"},
    {DeltaUnit::kRadians, "r"},
}};

std::vector<PosePair> pairs_by_index(std::size_t num_poses, std::size_t delta, bool all_pairs) {
  std::vector<PosePair> pairs;
  const std::size_t step = all_pairs ? 1 : delta;
  for (std::size_t i = 0; delta < num_poses && i < num_poses - delta; i += step) pairs.push_back({i, i + delta});
  return pairs;
}

std::vector<PosePair> consecutive_pairs_by_path(std::span<const Pose> poses, double delta_m) {
  std::vector<std::size_t> ends;
  double path_m = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    path_m += internal::step_length(poses[i - 1], poses[i]);
    if (path_m < delta_m) continue;
    ends.push_back(i);
    path_m = 0;
  }
  std::vector<PosePair> pairs;
  for (std::size_t k = 1; k < ends.size(); ++k) pairs.push_back({ends[k - 1], ends[k]});
  return pairs;
}

/// The j > i whose path length from i is nearest to delta_m; the first of those equally near. REQUIRES i + 1 < size.
std::size_t nearest_by_path(std::span<const double> path_m, std::size_t i, double delta_m) {
  const auto miss = [&](double at) { return (at - path_m[i]) - delta_m; };
  const auto begin = path_m.begin() + static_cast<std::ptrdiff_t>(i) + 1;
  const auto above = std::partition_point(begin, path_m.end(), [&](double at) { return miss(at) < 0; });
  auto nearest = above;
  if (above != begin && (above == path_m.end() || -miss(*(above - 1)) <= miss(*above))) {
    const double closest = miss(*(above - 1));
    nearest = std::partition_point(begin, above, [&](double at) { return miss(at) < closest; });
  }
  return static_cast<std::size_t>(nearest - path_m.begin());
}

std::vector<PosePair> all_pairs_by_path(const Trajectory& trajectory, double delta_m, double tolerance_m) {
  const std::vector<double> path_m = internal::path_lengths(trajectory);
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i + 1 < path_m.size(); ++i) {
    const std::size_t j = nearest_by_path(path_m, i, delta_m);
    if (std::abs((path_m[j] - path_m[i]) - delta_m) <= tolerance_m) pairs.push_back({i, j});
  }
  return pairs;
}

std::vector<PosePair> consecutive_pairs_by_angle(std::span<const Pose> poses, double delta_rad) {
  std::vector<PosePair> pairs;
  std::size_t start = 0;
  double turned_rad = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    turned_rad += rotation_angle(Eigen::Matrix3d(poses[i - 1].rotation.transpose() * poses[i].rotation));
    if (turned_rad < delta_rad) continue;
    pairs.push_back({start, i});
    start = i;
    turned_rad = 0;
  }
  return pairs;
}

std::vector<PosePair> all_pairs_by_angle(std::span<const Pose> poses, double delta_rad, double tolerance_rad) {
  std::vector<Eigen::Quaterniond> rotations;
  rotations.reserve(poses.size());
  for (const Pose& pose : poses) rotations.emplace_back(quaternion_direction(pose.rotation).normalized());
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Quaterniond inverse = rotations[i].conjugate();
    for (std::size_t j = i + 1; j < poses.size(); ++j) {
      const double angle_rad = rotation_angle(Eigen::Vector4d((inverse * rotations[j]).coeffs()));
      if (delta_rad - tolerance_rad <= angle_rad && angle_rad <= delta_rad + tolerance_rad) pairs.push_back({i, j});
    }
  }
  return pairs;
}

}  // namespace

std::string_view name_of(DeltaUnit unit) { return kUnits[static_cast<std::size_t>(unit)].second; }

std::optional<DeltaUnit> delta_unit_named(std::string_view name) {
  const auto* found =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& entry) { return entry.second == name; });
  if (found == kUnits.end()) return std::nullopt;
  return found->first;
}

void PosePairSettings::validate() const {
  const auto refuse = [&](std::string_view range) {
    throw InvalidArgument(fmt::format("delta = {} {} is out of range: it must be {}", delta, name_of(unit), range));
  };
  if (!(delta > 0 && std::isfinite(delta))) refuse("> 0");
  if (unit == DeltaUnit::kFrames && (delta != std::floor(delta) || delta > 1e15)) refuse("a whole number of frames");
  if (unit == DeltaUnit::kDegrees && delta > 180) refuse("at most 180 degrees");
  if (unit == DeltaUnit::kRadians && delta > std::numbers::pi) refuse("at most pi radians");
  if (!(relative_tolerance >= 0 && std::isfinite(relative_tolerance))) {
    throw InvalidArgument(fmt::format("relative_tolerance = {} is out of range: it must be >= 0", relative_tolerance));
  }
}

std::vector<PosePair> pose_pairs(const Trajectory& trajectory, const PosePairSettings& settings) {
  settings.validate();
  const std::span<const Pose> poses = trajectory.world_from_scan;
  const double tolerance = settings.delta * settings.relative_tolerance;
  if (settings.unit == DeltaUnit::kFrames) {
    return pairs_by_index(poses.size(), static_cast<std::size_t>(settings.delta), settings.all_pairs);
  }
  if (settings.unit == DeltaUnit::kMetres) {
    return settings.all_pairs ? all_pairs_by_path(trajectory, settings.delta, tolerance)
                              : consecutive_pairs_by_path(poses, settings.delta);
  }
  const double rad = settings.unit == DeltaUnit::kDegrees ? std::numbers::pi / 180 : 1;
  return settings.all_pairs ? all_pairs_by_angle(poses, settings.delta * rad, tolerance * rad)
                            : consecutive_pairs_by_angle(poses, settings.delta * rad);
}

}  // namespace trysquare
