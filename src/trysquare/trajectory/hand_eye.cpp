// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/hand_eye.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/internal/pose_error.h"
#include "trysquare/trajectory/internal/validate.h"
#include "trysquare/trajectory/rotation_angle.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>
#include <vector>

namespace trysquare {
namespace {

/// Smallest mean of (R_A − I)ᵀ(R_A − I) along any axis: 2·(1 − cos) of about 2°.
constexpr double kLeastTurn = 1.2e-3;

struct Motions {
  std::vector<Pose> of_body;
  std::vector<Pose> of_sensor;
};

/// Pairs of poses 1, 2, 4, ... apart, so that slow turns count as well.
Motions motions_of(const Trajectory& body, const Trajectory& sensor) {
  Motions motions;
  for (std::size_t apart = 1; apart < body.size(); apart *= 2) {
    for (std::size_t i = 0; i + apart < body.size(); ++i) {
      using internal::relative_pose;
      motions.of_body.push_back(relative_pose(body.world_from_scan[i], body.world_from_scan[i + apart]));
      motions.of_sensor.push_back(relative_pose(sensor.world_from_scan[i], sensor.world_from_scan[i + apart]));
    }
  }
  return motions;
}

/// (x, y, z, w) with w >= 0: of two equal turns in different frames the quaternions then have the same w.
Eigen::Vector4d quaternion_of(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector4d q = quaternion_direction(rotation).normalized();
  return q[3] < 0 ? Eigen::Vector4d(-q) : q;
}

/// The matrix of p ↦ a·p − p·b for quaternions (x, y, z, w).
Eigen::Matrix4d difference_of_products(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  const double w = a[3] - b[3];
  const Eigen::Vector3d sum = a.head<3>() + b.head<3>();
  const Eigen::Vector3d difference = a.head<3>() - b.head<3>();
  Eigen::Matrix4d m;
  m << w, -sum.z(), sum.y(), difference.x(),  //
      sum.z(), w, -sum.x(), difference.y(),   //
      -sum.y(), sum.x(), w, difference.z(),   //
      -difference.x(), -difference.y(), -difference.z(), w;
  return m;
}

Eigen::Matrix3d rotation_of(const Motions& motions) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  for (std::size_t k = 0; k < motions.of_body.size(); ++k) {
    const Eigen::Matrix4d m = difference_of_products(quaternion_of(motions.of_body[k].rotation),
                                                     quaternion_of(motions.of_sensor[k].rotation));
    normal += m.transpose() * m;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(normal);
  return Eigen::Quaterniond(Eigen::Vector4d(solver.eigenvectors().col(0))).normalized().toRotationMatrix();
}

Eigen::Vector3d translation_of(const Motions& motions, const Eigen::Matrix3d& body_from_sensor) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < motions.of_body.size(); ++k) {  // (R_A − I) t = R t_B − t_A
    const Eigen::Matrix3d turn = motions.of_body[k].rotation - Eigen::Matrix3d::Identity();
    normal += turn.transpose() * turn;
    right += turn.transpose() * (body_from_sensor * motions.of_sensor[k].translation - motions.of_body[k].translation);
  }
  return normal.ldlt().solve(right);
}

/// Motions that turn about one axis only leave the translation along it, and the rotation about it, open.
void require_turns(const Motions& motions) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (const Pose& motion : motions.of_body) {
    const Eigen::Matrix3d turn = motion.rotation - Eigen::Matrix3d::Identity();
    normal += turn.transpose() * turn / static_cast<double>(motions.of_body.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
  if (motions.of_body.empty() || !(solver.eigenvalues()[0] >= kLeastTurn)) {
    throw InvalidArgument(
        "the motions do not fix where the sensor sits on the body: they must turn about two different axes by several "
        "degrees, which driving on a plane does not; give the extrinsic instead");
  }
}

}  // namespace

HandEye hand_eye(const Trajectory& world_from_body, const Trajectory& world_from_sensor) {
  internal::validate_poses(world_from_body, world_from_sensor);
  const Motions motions = motions_of(world_from_body, world_from_sensor);
  require_turns(motions);
  HandEye result{.num_motions = motions.of_body.size()};
  result.body_from_sensor.rotation = rotation_of(motions);
  result.body_from_sensor.translation = translation_of(motions, result.body_from_sensor.rotation);
  const double n = static_cast<double>(result.num_motions);
  for (std::size_t k = 0; k < result.num_motions; ++k) {
    const Pose error = internal::relative_pose(motions.of_body[k] * result.body_from_sensor,
                                               result.body_from_sensor * motions.of_sensor[k]);
    result.translation_rms_m += error.translation.squaredNorm() / n;
    result.rotation_rms_rad += std::pow(rotation_angle(error.rotation), 2) / n;
  }
  result.translation_rms_m = std::sqrt(result.translation_rms_m);
  result.rotation_rms_rad = std::sqrt(result.rotation_rms_rad);
  return result;
}

}  // namespace trysquare
