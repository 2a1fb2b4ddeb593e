// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/pipeline/compare.h"

#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// What only the caller of compare() knows.
struct ComparisonFacts {
  std::string version;  ///< Of trysquare, e.g. "0.1.0".
  std::string scans;    ///< SCANS as typed.
  bool left_handed = false;

  /// Where a candidate came from.
  struct Source {
    std::string poses;                     ///< As typed.
    std::string poses_format;              ///< "kitti", "tum", ...
    std::optional<std::string> extrinsic;  ///< Where body_from_sensor came from; empty: none.
  };
  std::vector<Source> sources;  ///< In the order of the candidates.
};

/// The comparison as JSON text, schema "trysquare.comparison/1" (docs/schema/comparison.schema.json). Same input, same
/// bytes; what does not exist is null with `<key>_reason` beside it. Metres, degrees, m2, nats.
std::string to_json(const Comparison& comparison, const ComparisonFacts& facts);

/// The windows, one row for each candidate and window: trajectory, first, last, rpe_m, mom_m2, omme_nats, mpv_m2,
/// mme_nats, multi_scan_share. A value that does not exist is an empty cell.
std::string windows_csv(const Comparison& comparison);

/// "rpe" in "m", "mom" in "m2", ...
std::string_view unit_of(Metric metric);

}  // namespace trysquare
