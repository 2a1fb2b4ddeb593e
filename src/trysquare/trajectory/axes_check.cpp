// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/axes_check.h"

#include "trysquare/trajectory/internal/pose_error.h"
#include "trysquare/trajectory/internal/validate.h"
#include "trysquare/trajectory/rotation_angle.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace trysquare {
namespace {

constexpr double kFits = 0.8;  // cos 37°: a sensor that is tilted on its body still has a nearest axis
constexpr double kDoesNotFit = 0.5;
constexpr std::size_t kFewestMotions = 10;
constexpr std::size_t kMotions = 200;  // of a long run: each is long, too, so that noise is small beside it

/// Root mean squares below these are noise, whose direction says nothing.
constexpr double kStandsStill_m = 1e-3;
constexpr double kDoesNotTurn_rad = 1e-3;

/// Sums over the motions of what one kind of vector, in the frames of both, has in common.
struct Correlation {
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();  ///< Σ reference · estimateᵀ
  double reference_square = 0;
  double estimate_square = 0;

  void add(const Eigen::Vector3d& of_reference, const Eigen::Vector3d& of_estimate) {
    products += of_reference * of_estimate.transpose();
    reference_square += of_reference.squaredNorm();
    estimate_square += of_estimate.squaredNorm();
  }

  bool decides(std::size_t num_motions, double least) const {
    return std::min(reference_square, estimate_square) > least * least * static_cast<double>(num_motions);
  }

  double cosine(const Eigen::Matrix3d& reference_from_estimate) const {
    return products.cwiseProduct(reference_from_estimate).sum() / std::sqrt(reference_square * estimate_square);
  }
};

/// Angle times axis [rad].
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector4d direction = quaternion_direction(rotation);
  const Eigen::Vector3d axis = direction.head<3>() * (direction[3] < 0 ? -1 : 1);
  return axis.norm() > 0 ? Eigen::Vector3d(axis.normalized() * rotation_angle(direction)) : Eigen::Vector3d::Zero();
}

struct Motions {
  Correlation translations{};
  Correlation rotations{};
  std::size_t count = 0;
};

Motions motions_of(const Trajectory& reference, const Trajectory& estimate) {
  Motions motions;
  const std::size_t step = std::max<std::size_t>(1, reference.size() / kMotions);
  for (std::size_t i = 0; i + step < reference.size(); i += step) {
    using internal::relative_pose;
    const Pose of_reference = relative_pose(reference.world_from_scan[i], reference.world_from_scan[i + step]);
    const Pose of_estimate = relative_pose(estimate.world_from_scan[i], estimate.world_from_scan[i + step]);
    motions.translations.add(of_reference.translation, of_estimate.translation);
    motions.rotations.add(rotation_vector(of_reference.rotation), rotation_vector(of_estimate.rotation));
    ++motions.count;
  }
  return motions;
}

/// The 24 ways to name the axes of a right-handed frame; the identity is the first.
std::array<Eigen::Matrix3d, 24> right_handed_axes() {
  std::array<Eigen::Matrix3d, 24> all;
  std::array<Eigen::Index, 3> order = {0, 1, 2};
  std::size_t count = 0;
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
      for (int i = 0; i < 3; ++i) axes(i, order[static_cast<std::size_t>(i)]) = (signs & (1 << i)) == 0 ? 1 : -1;
      if (axes.determinant() > 0) all[count++] = axes;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return all;
}

/// "x = -y, y = -z, z = x": what the axes of the reference are in the estimate's names.
std::string names_of(const Eigen::Matrix3d& axes) {
  std::string text;
  for (Eigen::Index i = 0; i < 3; ++i) {
    Eigen::Index j = 0;
    axes.row(i).cwiseAbs().maxCoeff(&j);
    text += fmt::format("{}{} = {}{}", i > 0 ? ", " : "", "xyz"[i], axes(i, j) < 0 ? "-" : "", "xyz"[j]);
  }
  return text;
}

/// As --extrinsic takes it: 3×4, row by row.
std::string matrix_text(const Eigen::Matrix3d& axes) {
  std::string text;
  for (Eigen::Index i = 0; i < 3; ++i) {
    text += fmt::format("{}{} {} {} 0", i > 0 ? " " : "", axes(i, 0), axes(i, 1), axes(i, 2));
  }
  return text;
}

}  // namespace

std::optional<RenamedAxes> renamed_axes(const Trajectory& reference, const Trajectory& estimate) {
  internal::validate_poses(reference, estimate);
  const Motions motions = motions_of(reference, estimate);
  const bool moves = motions.translations.decides(motions.count, kStandsStill_m);
  const bool turns = motions.rotations.decides(motions.count, kDoesNotTurn_rad);
  if (motions.count < kFewestMotions || (!moves && !turns)) return std::nullopt;
  const auto translation_cosine = [&](const auto& axes) { return moves ? motions.translations.cosine(axes) : 1; };
  const auto rotation_cosine = [&](const auto& axes) { return turns ? motions.rotations.cosine(axes) : 1; };

  RenamedAxes result{.given_translation_cosine = translation_cosine(Eigen::Matrix3d::Identity()),
                     .given_rotation_cosine = rotation_cosine(Eigen::Matrix3d::Identity())};
  double best = -2;
  for (const Eigen::Matrix3d& axes : right_handed_axes()) {
    const double sum = translation_cosine(axes) + rotation_cosine(axes);
    if (sum <= best) continue;
    best = sum;
    result.reference_from_estimate = axes;
    result.translation_cosine = translation_cosine(axes);
    result.rotation_cosine = rotation_cosine(axes);
  }
  const bool other_axes_fit = std::min(result.translation_cosine, result.rotation_cosine) >= kFits;
  const bool given_axes_do_not = std::min(result.given_translation_cosine, result.given_rotation_cosine) <= kDoesNotFit;
  if (!other_axes_fit || !given_axes_do_not) return std::nullopt;
  return result;
}

std::optional<Diagnostic> check_axes(const Trajectory& reference, const Trajectory& estimate) {
  const std::optional<RenamedAxes> found = renamed_axes(reference, estimate);
  if (!found) return std::nullopt;
  return Diagnostic{
      "renamed_axes",
      fmt::format("the frames of the two differ: motions agree in direction when the axes of the reference are {} of "
                  "the estimate (cosine of translations {:.3f}, of rotations {:.3f}; as given {:.3f} and {:.3f}); one "
                  "may be of a camera, z forward, the other of a body, x forward: give --extrinsic \"{}\", or "
                  "--estimate-extrinsic",
                  names_of(found->reference_from_estimate), found->translation_cosine, found->rotation_cosine,
                  found->given_translation_cosine, found->given_rotation_cosine,
                  matrix_text(found->reference_from_estimate))};
}

}  // namespace trysquare
