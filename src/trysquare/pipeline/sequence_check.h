// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/pipeline/finding.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// What a scan is recognised by, without its points.
struct ScanIdentity {
  std::size_t num_points = 0;
  std::uint64_t digest = 0;  ///< Of the points: scans with equal points have equal ones.
  std::optional<std::int64_t> stamp_ns;
  std::string name;
};

/// Loads every scan once.
/// @throws IoError  from ScanSequence::load().
std::vector<ScanIdentity> identify_scans(const ScanSequence& scans, const Execution& execution = {});

/// Scans that are there twice: "duplicate_scans", all points equal to the bit.
std::optional<Finding> check_duplicates(const std::vector<ScanIdentity>& scans);

/// Gaps in a sequence, "missing_scans": a step of at least 1.7 usual ones, in time where there are stamps; else in the
/// numbers at the end of the names, where these ascend in equal steps; else in the way between poses, where the five
/// steps on either side differ by at most a fifth.
///
/// @param stamps_ns  Of the scans, or empty.
/// @return           A warning; of gaps seen in the way only, a note.
std::optional<Finding> check_gaps(const std::vector<ScanIdentity>& scans, const std::vector<std::int64_t>& stamps_ns,
                                  const Trajectory& trajectory);

}  // namespace trysquare
