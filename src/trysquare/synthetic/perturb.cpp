// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/perturb.h"

#include "trysquare/core/error.h"
#include "trysquare/synthetic/random.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <string>

namespace trysquare {
namespace {

void require_sigma(const char* name, double value) {
  if (value >= 0 && std::isfinite(value)) return;
  throw InvalidArgument(std::string(name) + " = " + std::to_string(value) + " is out of range: it must be >= 0");
}

Eigen::Matrix3d exponential(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
}

/// An error of one pose, or of one step.
Pose draw(const PerturbationSettings& settings, std::size_t index) {
  Random random(settings.seed, index);
  const Eigen::Vector3d translation = settings.translation_sigma_m * random.normal_vector();
  return {exponential(settings.rotation_sigma_rad * random.normal_vector()), translation};
}

}  // namespace

std::optional<NoiseModel> noise_model_named(std::string_view name) {
  for (const NoiseModel model : {NoiseModel::kWhite, NoiseModel::kWalk}) {
    if (name_of(model) == name) return model;
  }
  return std::nullopt;
}

void PerturbationSettings::validate() const {
  require_sigma("translation_sigma_m", translation_sigma_m);
  require_sigma("rotation_sigma_rad", rotation_sigma_rad);
}

Trajectory perturb(const Trajectory& trajectory, const PerturbationSettings& settings) {
  settings.validate();
  Trajectory result = trajectory;
  Pose walked;
  for (std::size_t i = 0; i < result.size(); ++i) {
    Pose error = draw(settings, i);
    if (settings.model == NoiseModel::kWalk) {
      if (i > 0) walked = {walked.rotation * error.rotation, walked.translation + error.translation};
      error = walked;
    }
    Pose& pose = result.world_from_scan[i];
    pose.translation += error.translation;
    pose.rotation = pose.rotation * error.rotation;
  }
  return result;
}

}  // namespace trysquare
