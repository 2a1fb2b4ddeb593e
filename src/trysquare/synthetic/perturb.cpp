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

}  // namespace

void PerturbationSettings::validate() const {
  require_sigma("translation_sigma_m", translation_sigma_m);
  require_sigma("rotation_sigma_rad", rotation_sigma_rad);
}

Trajectory perturb(const Trajectory& trajectory, const PerturbationSettings& settings) {
  settings.validate();
  Trajectory result = trajectory;
  for (std::size_t i = 0; i < result.size(); ++i) {
    Random random(settings.seed, i);
    Pose& pose = result.world_from_scan[i];
    pose.translation += settings.translation_sigma_m * random.normal_vector();
    pose.rotation = pose.rotation * exponential(settings.rotation_sigma_rad * random.normal_vector());
  }
  return result;
}

}  // namespace trysquare
