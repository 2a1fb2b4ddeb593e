// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/trajectory/ape.h"
#include "trysquare/trajectory/rpe.h"
#include "trysquare/trajectory/trajectory_errors.h"

#include <cstddef>
#include <string>

namespace trysquare {

/// What only the caller of ape() or rpe() knows.
struct TrajectoryErrorsFacts {
  std::string version;    ///< Of trysquare.
  std::string reference;  ///< REFERENCE as typed.
  std::string estimate;   ///< ESTIMATE as typed.
  std::size_t num_associated = 0;
  std::size_t num_unmatched_reference = 0;
  std::size_t num_unmatched_estimate = 0;
  std::string reason{};  ///< Why there are no errors, when there are none.
};

/// APE or RPE as JSON text, schema "trysquare.trajectory/1" (docs/schema/trajectory.schema.json): the statistics under
/// evo's names in the unit of the relation, and everything that decides them. Without errors, statistics and scale are
/// null with facts.reason beside them. Same input, same bytes.
std::string to_json(const TrajectoryErrors& errors, const ApeSettings& settings, const TrajectoryErrorsFacts& facts);
std::string to_json(const TrajectoryErrors& errors, const RpeSettings& settings, const TrajectoryErrorsFacts& facts);

}  // namespace trysquare
