// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/extract_orthogonal_subset.h"
#include "trysquare/pipeline/orthogonal_windows.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace trysquare {

/// What only the caller of extract_orthogonal_subset() knows.
struct OrthogonalFacts {
  std::string version;                           ///< Of trysquare.
  std::string scans;                             ///< SCANS as typed.
  std::optional<std::string> poses{};            ///< POSES as typed.
  bool left_handed = false;                      ///< Whether y of points and poses was negated.
  std::optional<std::string> extrinsic{};        ///< Where body_from_sensor came from, e.g. "calib.txt:Tr".
  double radius_m = 0;                           ///< Of the neighborhoods.
  std::size_t num_scans = 0;                     ///< Scans that were chosen; the method looks at some of them.
  std::string windows_reason = "not asked for";  ///< Why there are no windows, when there are none.
};

/// An orthogonal subset as JSON text, schema "trysquare.orthogonal/1" (docs/schema/orthogonal.schema.json): per
/// direction its unit normal in the map frame (the first scan's) and its number of points, the angles between the
/// normals in degrees, and what the directions were found among; the same for every window. Same input, same bytes.
std::string to_json(const OrthogonalSubsetResult& result, const OrthogonalSubsetSettings& settings,
                    const OrthogonalFacts& facts, std::span<const OrthogonalWindow> windows = {});

}  // namespace trysquare
