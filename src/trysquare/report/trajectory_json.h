// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/diagnostic.h"
#include "trysquare/trajectory/all_pairs_rpe.h"
#include "trysquare/trajectory/ape.h"
#include "trysquare/trajectory/association.h"
#include "trysquare/trajectory/error_by_length.h"
#include "trysquare/trajectory/hand_eye.h"
#include "trysquare/trajectory/kitti_drift.h"
#include "trysquare/trajectory/rpe.h"
#include "trysquare/trajectory/trajectory_errors.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// What was done to the trajectories before they were compared.
struct TrajectoryPreparation {
  AssociationSettings association{};
  std::optional<std::size_t> downsample{};
  std::optional<std::array<double, 2>> motion_filter_m_deg{};
  std::optional<double> t_start_s{};
  std::optional<double> t_end_s{};
  std::string transform_left{};   ///< As typed; empty: none.
  std::string transform_right{};  ///< As typed; empty: none.
  std::string extrinsic{};        ///< As typed, or "estimated"; empty: none.
};

/// What only the caller of ape() or rpe() knows.
struct TrajectoryErrorsFacts {
  std::string version;    ///< Of trysquare.
  std::string reference;  ///< REFERENCE as typed.
  std::string estimate;   ///< ESTIMATE as typed.
  std::size_t num_associated = 0;
  std::size_t num_unmatched_reference = 0;
  std::size_t num_unmatched_estimate = 0;
  std::string reason{};  ///< Why there are no errors, when there are none.
  std::size_t num_extrapolated = 0;
  std::optional<double> median_time_difference_s{};
  TrajectoryPreparation preparation{};
  std::vector<double> quantiles{};    ///< Shares in [0, 1] whose quantiles are wanted.
  std::optional<HandEye> hand_eye{};  ///< When the extrinsic was estimated.
  std::vector<Diagnostic> warnings{};
};

/// Relative errors of other kinds, of the same trajectories.
struct RelativeErrors {
  std::optional<KittiDrift> kitti_drift{};
  std::vector<ErrorOfLength> by_length{};
  std::optional<AllPairsRpe> every_pair{};
  std::optional<double> paper_rpe_m2{};
};

/// APE or RPE as JSON text, schema "trysquare.trajectory/1" (docs/schema/trajectory.schema.json): the statistics under
/// evo's names in the unit of the relation, and everything that decides them. Without errors, statistics and scale are
/// null with facts.reason beside them. Same input, same bytes.
std::string to_json(const TrajectoryErrors& errors, const ApeSettings& settings, const TrajectoryErrorsFacts& facts);
std::string to_json(const TrajectoryErrors& errors, const RpeSettings& settings, const TrajectoryErrorsFacts& facts,
                    const RelativeErrors& others = {});

}  // namespace trysquare
