// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/suspect_poses.h"

#include "trysquare/stats/median.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace trysquare {
namespace {

constexpr std::size_t kReach = 10;  ///< Poses on either side that say what is usual.
constexpr std::size_t kFewestPoses = 4;
constexpr double kSuspectScore = 4.0;       ///< Chance alone: one of 900 at three axes.
constexpr double kLeastSigma_m = 5e-4;      ///< Below that nothing is known.
constexpr double kLeastSigma_rad = 1e-4;

Eigen::Vector3d median_of(const std::vector<Eigen::Vector3d>& vectors) {
  Eigen::Vector3d result;
  std::vector<double> component(vectors.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(vectors.begin(), vectors.end(), component.begin(), [&](const auto& each) { return each[axis]; });
    result[axis] = median_of_defined(component).value_or(0);
  }
  return result;
}

/// The error of pose i beyond the median motion of poses [begin, end) as seen at its place.
PoseError beyond_median(std::size_t i, std::size_t begin, std::size_t end, const std::vector<PoseError>& errors,
                        std::span<const Pose> given) {
  std::vector<Eigen::Vector3d> rotations;
  for (std::size_t j = begin; j < end; ++j) rotations.push_back(errors[j].rotation_rad);
  const Eigen::Vector3d rotation_rad = median_of(rotations);
  std::vector<Eigen::Vector3d> translations;
  for (std::size_t j = begin; j < end; ++j) {
    const Eigen::Vector3d lever = given[j].translation - given[i].translation;
    translations.push_back(errors[j].translation_m - rotation_rad.cross(lever));
  }
  return {.translation_m = errors[i].translation_m - median_of(translations),
          .rotation_rad = errors[i].rotation_rad - rotation_rad};
}

/// Robust standard deviation of one axis.
double usual(const std::vector<PoseDeviation>& deviations, Eigen::Vector3d PoseError::*part, double least) {
  std::vector<double> magnitudes;
  for (const PoseDeviation& each : deviations) {
    for (int axis = 0; axis < 3; ++axis) magnitudes.push_back(std::abs((each.error.*part)[axis]));
  }
  return 1.4826 * median_of_defined(magnitudes).value_or(0) + least;
}

}  // namespace

std::vector<PoseDeviation> deviations_of_poses(std::span<const Pose> given, std::span<const Pose> corrected) {
  std::vector<PoseError> errors;
  for (std::size_t i = 0; i < given.size(); ++i) errors.push_back(error_between(given[i], corrected[i]));
  std::vector<PoseDeviation> result(given.size());
  const std::size_t width = std::min(given.size(), 2 * kReach + 1);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::size_t begin = std::min(i - std::min(i, kReach), given.size() - width);
    result[i].error = beyond_median(i, begin, begin + width, errors, given);
  }
  const double sigma_m = usual(result, &PoseError::translation_m, kLeastSigma_m);
  const double sigma_rad = usual(result, &PoseError::rotation_rad, kLeastSigma_rad);
  for (PoseDeviation& each : result) {
    each.score = std::max(each.error.translation_m.norm() / sigma_m, each.error.rotation_rad.norm() / sigma_rad);
    each.suspect = given.size() >= kFewestPoses && each.score > kSuspectScore;
  }
  return result;
}

}  // namespace trysquare
