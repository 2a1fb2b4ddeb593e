// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/handedness_check.h"

#include "trysquare/core/handedness.h"
#include "trysquare/trajectory/all_pairs_rpe.h"

#include <fmt/format.h>

#include <cmath>

namespace trysquare {
namespace {

constexpr double kShareLeft = 0.5;
constexpr double kLeastGain_m = 0.01;
constexpr double kLever_m = 10;

double error_m(const Trajectory& adjusted, const Trajectory& poses) {
  const AllPairsRpe errors = all_pairs_rpe(adjusted, poses);
  return std::hypot(errors.translation_m.rmse, kLever_m * errors.rotation_rad.rmse);
}

}  // namespace

std::optional<Finding> check_handedness(const Trajectory& given, const Trajectory& adjusted) {
  const double given_m = error_m(adjusted, given);
  const double mirrored_m = error_m(adjusted, with_y_negated(given));
  if (mirrored_m > kShareLeft * given_m || given_m - mirrored_m < kLeastGain_m) return std::nullopt;
  return Finding{
      .id = "left_handed",
      .severity = Severity::kError,
      .message = fmt::format("one of poses and points looks left-handed, the other right-handed: with y of the "
                             "poses negated {:.1f} mm of error are left, {:.0f} % of the {:.1f} mm as given "
                             "(limit {:.0f} %)",
                             1000 * mirrored_m, 100 * mirrored_m / given_m, 1000 * given_m, 100 * kShareLeft),
      .remedy =
          "negate y of one of them (of poses: S T S with S = diag(1, -1, 1, 1)); where both are "
          "left-handed, give --left-handed",
      .evidence = Evidence{mirrored_m / given_m, kShareLeft, ""}};
}

}  // namespace trysquare
