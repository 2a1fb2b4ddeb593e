// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/pipeline/evaluation.h"

#include <optional>
#include <string>

namespace trysquare {

/// What only the caller of evaluate() knows: where the inputs came from. Strings go into the JSON as they are; bytes
/// that are not UTF-8 become U+FFFD.
struct EvaluationFacts {
  std::string version;                      ///< Of trysquare, e.g. "0.1.0".
  std::string scans;                        ///< SCANS (or the map's file) as the user typed it.
  std::optional<std::string> poses;         ///< POSES as typed; empty for a map.
  bool left_handed = false;                 ///< Whether y of points and poses was negated.
  std::optional<std::string> poses_format;  ///< "kitti", "tum", ...
  std::optional<std::string> extrinsic;     ///< Where body_from_sensor came from, e.g. "calib.txt:Tr"; empty: none.
  std::optional<std::string> reference;     ///< Reference trajectory as typed.
  std::optional<std::string> reference_extrinsic;  ///< Where the reference's body_from_sensor came from.
  std::optional<std::string> subset;               ///< Precomputed orthogonal subset as typed; empty: it was extracted.
  std::optional<double> wall_time_s;               ///< Only when timings were asked for: they differ from run to run.
};

/// The evaluation as JSON text, schema "trysquare.evaluation/1" (docs/schema/evaluation.schema.json).
///
/// Same input, same bytes: keys in a fixed order, two spaces of indent, numbers as the shortest text that reads back to
/// the same double, no time and no machine. A value that does not exist is null with the reason beside it: `reason`
/// next to `value`, `<key>_reason` next to any other key. Angles in degrees, variances in m2, entropies in nats.
/// The map and the values of its points are not part of it.
std::string to_json(const Evaluation& evaluation, const EvaluationFacts& facts);

}  // namespace trysquare
