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
constexpr double kLeastSigma_m = 5e-4;  ///< Below that nothing is known.
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

/// Robust standard deviation of one axis: Huber's second proposal, from magnitudes of all axes. Of thirty of them a
/// median alone would be off by a fifth, which makes suspects by chance.
double scale_of(const std::vector<double>& magnitudes) {
  constexpr double kSigmaOfMedian = 1.4826;        // of a normal distribution, as is the next
  constexpr double kClip = 2;                      // Magnitudes count up to this many scales.
  constexpr double kMeanClippedSquare = 0.920537;  // of a standard normal variable, clipped there
  constexpr int kSteps = 20;
  double scale = kSigmaOfMedian * median_of_defined(magnitudes).value_or(0);
  for (int step = 0; step < kSteps; ++step) {
    double sum = 0;
    for (const double magnitude : magnitudes) sum += std::pow(std::min(magnitude, kClip * scale), 2);
    scale = std::sqrt(sum / (static_cast<double>(magnitudes.size()) * kMeanClippedSquare));
  }
  return scale;
}

std::vector<double> magnitudes_of(const std::vector<Eigen::Vector3d>& vectors, const Eigen::Vector3d& from) {
  std::vector<double> magnitudes;
  for (const Eigen::Vector3d& each : vectors) {
    for (int axis = 0; axis < 3; ++axis) magnitudes.push_back(std::abs(each[axis] - from[axis]));
  }
  return magnitudes;
}

/// Median over all pairs of the change from one vector to the next (Theil and Sen): steady drift, whatever a few do.
Eigen::Vector3d drift_of(const std::vector<Eigen::Vector3d>& vectors) {
  std::vector<Eigen::Vector3d> slopes;
  for (std::size_t j = 0; j < vectors.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) slopes.push_back((vectors[j] - vectors[i]) / static_cast<double>(j - i));
  }
  return median_of(slopes);
}

/// The error of pose i beyond the median motion of the poses [begin, end) as seen at its place, drift taken
/// out if asked for.
PoseError beyond_shared(std::size_t i, std::size_t begin, std::size_t end, const std::vector<PoseError>& errors,
                        std::span<const Pose> given, bool without_drift) {
  std::vector<Eigen::Vector3d> rotations;
  for (std::size_t j = begin; j < end; ++j) rotations.push_back(errors[j].rotation_rad);
  const Eigen::Vector3d rotation_rad = median_of(rotations);
  std::vector<Eigen::Vector3d> translations;
  for (std::size_t j = begin; j < end; ++j) {
    const Eigen::Vector3d lever = given[j].translation - given[i].translation;
    translations.push_back(errors[j].translation_m - rotation_rad.cross(lever));
  }
  if (without_drift) {
    const Eigen::Vector3d drift_m = drift_of(translations);
    for (std::size_t j = begin; j < end; ++j) {
      translations[j - begin] -= (static_cast<double>(j) - static_cast<double>(i)) * drift_m;
    }
  }
  return {.translation_m = errors[i].translation_m - median_of(translations),
          .rotation_rad = errors[i].rotation_rad - rotation_rad};
}

/// What is usual of one axis.
double usual(const std::vector<PoseDeviation>& deviations, Eigen::Vector3d PoseError::*part, double least) {
  std::vector<Eigen::Vector3d> vectors;
  for (const PoseDeviation& each : deviations) vectors.push_back(each.error.*part);
  return scale_of(magnitudes_of(vectors, Eigen::Vector3d::Zero())) + least;
}

}  // namespace

std::vector<PoseDeviation> deviations_of_poses(std::span<const Pose> given, std::span<const Pose> corrected) {
  std::vector<PoseError> errors;
  for (std::size_t i = 0; i < given.size(); ++i) errors.push_back(error_between(given[i], corrected[i]));
  std::vector<PoseDeviation> result(given.size());
  const std::size_t width = std::min(given.size(), 2 * kReach + 1);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::size_t begin = std::min(i - std::min(i, kReach), given.size() - width);
    result[i].error = beyond_shared(i, begin, begin + width, errors, given, given.size() > width);
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
