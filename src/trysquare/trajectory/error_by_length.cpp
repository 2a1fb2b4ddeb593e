// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/error_by_length.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/internal/path_length.h"
#include "trysquare/trajectory/internal/pose_error.h"
#include "trysquare/trajectory/internal/validate.h"
#include "trysquare/trajectory/pose_pairs.h"
#include "trysquare/trajectory/rotation_angle.h"

#include <fmt/format.h>

#include <cmath>

namespace trysquare {
namespace {

std::vector<double> lengths_of(const ErrorByLengthSettings& settings, double path_m) {
  if (!settings.lengths_m.empty()) return settings.lengths_m;
  std::vector<double> lengths_m;
  for (const double share : settings.shares) lengths_m.push_back(share * path_m);
  return lengths_m;
}

ErrorOfLength error_of_length(const Trajectory& reference, const Trajectory& estimate, double length_m,
                              double relative_tolerance) {
  ErrorOfLength result{.length_m = length_m};
  const std::vector<PosePair> pairs = pose_pairs(
      reference,
      {.delta = length_m, .unit = DeltaUnit::kMetres, .relative_tolerance = relative_tolerance, .all_pairs = true});
  if (pairs.empty()) {
    result.reason =
        fmt::format("no part of the reference is {:.6g} m long, within {:g} of that", length_m, relative_tolerance);
    return result;
  }
  std::vector<double> translation_m;
  std::vector<double> translation_percent;
  std::vector<double> rotation_rad;
  for (const PosePair& pair : pairs) {
    using internal::relative_pose;
    const Pose motion = relative_pose(reference.world_from_scan[pair.first], reference.world_from_scan[pair.second]);
    const Pose estimated = relative_pose(estimate.world_from_scan[pair.first], estimate.world_from_scan[pair.second]);
    const Pose error = relative_pose(motion, estimated);
    translation_m.push_back(error.translation.norm());
    translation_percent.push_back(100 * translation_m.back() / length_m);
    rotation_rad.push_back(rotation_angle(error.rotation));
  }
  result.translation_m = error_statistics(translation_m);
  result.translation_percent = error_statistics(translation_percent);
  result.rotation_rad = error_statistics(rotation_rad);
  return result;
}

}  // namespace

void ErrorByLengthSettings::validate() const {
  for (const double length_m : lengths_m) {
    if (!(length_m > 0 && std::isfinite(length_m))) {
      throw InvalidArgument(fmt::format("lengths_m has {}, which is out of range: it must be > 0", length_m));
    }
  }
  if (lengths_m.empty() && shares.empty()) throw InvalidArgument("neither lengths_m nor shares has a value");
  for (const double share : shares) {
    if (!(share > 0 && share <= 1)) {
      throw InvalidArgument(fmt::format("shares has {}, which is out of range: it must be in (0, 1]", share));
    }
  }
  if (!(relative_tolerance >= 0 && std::isfinite(relative_tolerance))) {
    throw InvalidArgument(fmt::format("relative_tolerance = {} is out of range: it must be >= 0", relative_tolerance));
  }
}

std::vector<ErrorOfLength> error_by_length(const Trajectory& reference, const Trajectory& estimate,
                                           const ErrorByLengthSettings& settings) {
  settings.validate();
  internal::validate_poses(reference, estimate);
  const double path_m = internal::path_lengths(reference).back();
  if (!(path_m > 0)) throw InvalidArgument("the reference does not move: its path has no length");
  std::vector<ErrorOfLength> result;
  for (const double length_m : lengths_of(settings, path_m)) {
    result.push_back(error_of_length(reference, estimate, length_m, settings.relative_tolerance));
  }
  return result;
}

}  // namespace trysquare
