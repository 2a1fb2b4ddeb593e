// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/point_statistics.h"

#include <cstddef>
#include <optional>

namespace trysquare {

/// How much the scans of a map see of each other. Without overlap every metric is blind to the poses, and a broken
/// trajectory looks better than a good one: the scans fly apart and each neighborhood holds one clean scan.
struct Overlap {
  std::size_t num_neighborhoods = 0;                  ///< Used neighborhoods: with at least min_neighbors points.
  std::optional<double> scans_per_neighborhood_mean;  ///< Distinct scans in a used neighborhood, on average.
  std::optional<double> multi_scan_share;             ///< Share of used neighborhoods with at least two scans.
  std::optional<double> neighbors_mean;               ///< Points in a neighborhood, over all queries.
  std::optional<double> line_like_share;  ///< Share of used neighborhoods that are line-like (λ₂ <= 0.01 λ₃).
};

/// Below this share of neighborhoods with two scans or more, map metrics mean nothing (docs/definitions.md#overlap).
inline constexpr double kLeastMultiScanShare = 0.8;

/// @return  Without used neighborhoods all optional members but neighbors_mean are empty; that one is without queries.
Overlap overlap(const PointStatistics& points);

}  // namespace trysquare
