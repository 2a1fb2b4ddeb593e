// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/definition.h"
#include "trysquare/metrics/metric_result.h"
#include "trysquare/metrics/point_statistics.h"

namespace trysquare {

/// Mean Map Entropy (MME): mean of h(p) = ½ ln det(2πe Σ(p)) over the used, non-degenerate query points.
/// In nats; lower is better; it has no zero point: compare maps of one scene at one radius only.
///
/// @param points      Their entropies must have been computed with the same `definition`.
/// @param definition  kAisBonn: undefined and degenerate points enter the mean as 0. Others: they are left out.
/// @return            Value in nats; empty when no point is defined. Degenerate points are counted.
///
/// Properties (mme_test.cpp), up to rounding:
///   (1) invariant under rigid motions and the order of the points;
///   (2) larger by 3 ln s for a map s times as large, with a radius s times as large.
///
/// Source:  paper §III-B, with the logarithm that its formula lacks; Droeschel & Behnke 2014.
/// Differs: docs/definitions.md#mme. Cost: O(M).
MetricResult mme(const PointStatistics& points, Definition definition = Definition::kPaper);

}  // namespace trysquare
