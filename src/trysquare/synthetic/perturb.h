// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace trysquare {

/// How the errors of neighboring poses hang together.
enum class NoiseModel {
  kWhite,  ///< Every pose has an error of its own.
  kWalk,   ///< Every step from a pose to the next has an error of its own; they add up. The first pose has none.
};

/// "white", "walk".
constexpr std::string_view name_of(NoiseModel model) { return model == NoiseModel::kWhite ? "white" : "walk"; }

/// The model that name_of() calls `name`; nullopt when there is none.
std::optional<NoiseModel> noise_model_named(std::string_view name);

/// Normal noise on poses, independent from axis to axis, and from pose to pose (white) or from step to step (walk).
struct PerturbationSettings {
  double translation_sigma_m = 0;  ///< Standard deviation per axis of the world frame [m], >= 0.
  double rotation_sigma_rad = 0;   ///< Standard deviation per axis of the rotation vector, in the scan frame, >= 0.
  std::uint64_t seed = 0;
  NoiseModel model = NoiseModel::kWhite;

  /// @throws InvalidArgument  if a member is not finite or negative.
  void validate() const;
};

/// `trajectory` with random errors: world_from_scan becomes (R · Q, t + e). White noise: Q_i = exp(ω_i), e_i drawn for
/// pose i. Random walk: Q_i = Q_{i−1} · exp(ω_i), e_i = e_{i−1} + a draw, Q_0 = I, e_0 = 0. Pose i draws the same
/// numbers whatever the number of poses; stamps are kept.
///
/// Source: Kornilova & Ferrer, "Be your own Benchmark", §V-A.
Trajectory perturb(const Trajectory& trajectory, const PerturbationSettings& settings);

}  // namespace trysquare
