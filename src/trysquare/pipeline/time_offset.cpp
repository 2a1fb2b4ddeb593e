// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/time_offset.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/all_pairs_rpe.h"
#include "trysquare/trajectory/interpolation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trysquare {
namespace {

constexpr double kStep_s = 0.025;
constexpr double kLever_m = 10;                     ///< A rotation counts as what it does at this distance.
constexpr double kShareLeft = 0.5;                  ///< Of the error at most so much may be left.
constexpr double kResolutionsThatShow = 1.7320508;  ///< √(1 / kShareLeft² − 1).
constexpr double kLeastGain_m = 0.01;               ///< The error must fall by at least this.
constexpr std::size_t kFewestScans = 6;             ///< One number explains too much of fewer.

std::int64_t nanoseconds(double seconds) { return std::llround(1e9 * seconds); }

/// A source of poses and the scans that it covers at every offset.
class ShiftedPoses {
 public:
  ShiftedPoses(const Trajectory& poses, std::span<const std::int64_t> scan_stamps_ns, const Trajectory& adjusted,
               int num_steps)
      : poses_(poses) {
    for (std::size_t i = 0; i < scan_stamps_ns.size(); ++i) {
      bool is_covered = true;
      for (int step = -num_steps; step <= num_steps && is_covered; ++step) {
        const std::int64_t time_ns = scan_stamps_ns[i] + nanoseconds(step * kStep_s);
        is_covered = poses_.at(time_ns, kAnyGap).place == PoseInterpolator::Place::kInside;
      }
      if (!is_covered) continue;
      stamps_ns_.push_back(scan_stamps_ns[i]);
      adjusted_.world_from_scan.push_back(adjusted.world_from_scan[i]);
    }
  }

  std::size_t num_scans() const { return stamps_ns_.size(); }

  TimeOffsetCost cost(double offset_s) const {
    Trajectory shifted;
    for (const std::int64_t stamp_ns : stamps_ns_) {
      shifted.world_from_scan.push_back(poses_.at(stamp_ns + nanoseconds(offset_s), kAnyGap).world_from_scan);
    }
    const AllPairsRpe errors = all_pairs_rpe(adjusted_, shifted);
    return {.offset_s = offset_s,
            .error_m = std::hypot(errors.translation_m.rmse, kLever_m * errors.rotation_rad.rmse)};
  }

 private:
  static constexpr std::int64_t kAnyGap = std::numeric_limits<std::int64_t>::max();
  PoseInterpolator poses_;
  std::vector<std::int64_t> stamps_ns_;
  Trajectory adjusted_;
};

/// The parabola through the squared errors around the best of those tried: its lowest point and half its curvature.
struct Parabola {
  double lowest_s = 0;
  double per_s2 = 0;  ///< Squared error [m²] gained per squared offset [s²].
};

Parabola parabola_at(const std::vector<TimeOffsetCost>& costs, std::size_t best) {
  const std::size_t middle = std::clamp<std::size_t>(best, 1, costs.size() - 2);
  const auto square = [&](std::size_t i) { return costs[i].error_m * costs[i].error_m; };
  const double curvature = square(middle - 1) - 2 * square(middle) + square(middle + 1);
  Parabola result{.lowest_s = costs[best].offset_s, .per_s2 = curvature / (2 * kStep_s * kStep_s)};
  if (curvature > 0 && middle == best) {
    result.lowest_s += kStep_s * std::clamp(0.5 * (square(middle - 1) - square(middle + 1)) / curvature, -0.5, 0.5);
  }
  return result;
}

/// Names the best offset, or says why not.
void judge(TimeOffset& result) {
  const double given_m = result.costs[result.costs.size() / 2].error_m;
  const double left_m = result.best->error_m;
  if (left_m <= kShareLeft * given_m && given_m - left_m >= kLeastGain_m) {
    result.offset_s = result.best->offset_s;
    return;
  }
  result.reason = fmt::format(
      "no offset explains the errors: {:.1f} mm as given, {:.1f} mm at the best offset, {:.0f} ms; {}", 1000 * given_m,
      1000 * left_m, std::round(1000 * result.best->offset_s) + 0.0,
      result.resolution_s
          ? fmt::format("one of about {:.0f} ms would show", 1000 * *result.resolution_s * kResolutionsThatShow)
          : std::string("the motion is so steady that none would show"));
}

}  // namespace

TimeOffset find_time_offset(const Trajectory& poses, std::span<const std::int64_t> scan_stamps_ns,
                            const Trajectory& adjusted, double max_offset_s) {
  if (scan_stamps_ns.size() != adjusted.size()) {
    throw InvalidArgument(fmt::format("{} times of scans and {} adjusted poses: the numbers must be equal",
                                      scan_stamps_ns.size(), adjusted.size()));
  }
  if (!(max_offset_s > 0 && std::isfinite(max_offset_s))) {
    throw InvalidArgument(fmt::format("max_offset_s = {} is out of range: it must be > 0", max_offset_s));
  }
  const int num_steps = std::max(1, static_cast<int>(std::floor(max_offset_s / kStep_s + 1e-9)));
  const ShiftedPoses shifted(poses, scan_stamps_ns, adjusted, num_steps);
  TimeOffset result{.num_scans = shifted.num_scans()};
  if (result.num_scans < kFewestScans) {
    result.reason = fmt::format("{} scans have poses from {} s before to {} s after them ({} are needed)",
                                result.num_scans, num_steps * kStep_s, num_steps * kStep_s, kFewestScans);
    return result;
  }
  for (int step = -num_steps; step <= num_steps; ++step) result.costs.push_back(shifted.cost(step * kStep_s));
  const auto lowest = std::min_element(result.costs.begin(), result.costs.end(),
                                       [](const auto& a, const auto& b) { return a.error_m < b.error_m; });
  const Parabola parabola = parabola_at(result.costs, static_cast<std::size_t>(lowest - result.costs.begin()));
  result.best = shifted.cost(parabola.lowest_s);
  if (result.best->error_m > lowest->error_m) result.best = *lowest;
  if (parabola.per_s2 > 0) result.resolution_s = result.best->error_m / std::sqrt(parabola.per_s2);
  judge(result);
  return result;
}

}  // namespace trysquare
