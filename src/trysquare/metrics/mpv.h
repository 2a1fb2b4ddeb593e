// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/metric_result.h"
#include "trysquare/metrics/point_statistics.h"

namespace trysquare {

/// Mean Plane Variance (MPV): mean of v(p) = λ₁ over the used query points.
/// In m²; lower is better; 0 for an exactly planar map. Its root is a wall thickness in metres.
///
/// @return  Value in m²; empty when no point has enough neighbors. Degenerate points enter as 0 and are counted.
///
/// Properties (mpv_test.cpp), up to rounding:
///   (1) invariant under rigid motions and the order of the points;
///   (2) s² times as large for a map s times as large, with a radius s times as large.
///
/// Source: paper §III-B. Cost: O(M).
MetricResult mpv(const PointStatistics& points);

}  // namespace trysquare
