// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/definition.h"
#include "trysquare/metrics/orthogonal_metric_result.h"
#include "trysquare/metrics/orthogonal_statistics.h"

namespace trysquare {

/// Mutually Orthogonal Metric (MOM): mean plane variance, averaged over the directions of an orthogonal subset.
/// In m²; lower is better; the noise floor of the sensor is the least a real map can reach.
///
/// @param subset      Statistics of the orthogonal subset; see orthogonal_statistics().
/// @param definition  kMapMetrics: the sum of the medians is `value`. Others: the average of the means.
/// @return            Value in m². A degenerate scene is a result, not an error.
///
/// Properties (mom_test.cpp), up to rounding:
///   (1) mom(T·map, T·subset) == mom(map, subset) for every rigid T, and for every order of the points;
///   (2) mom(s·map, s·subset; s·radius) == s² · mom(map, subset; radius);
///   (3) it is the average of the MPVs of its directions.
///
/// Source:  Kornilova & Ferrer, "Be your own Benchmark", §IV-A, steps 1-3.
/// Differs: the reference implementation takes median and sum instead; docs/definitions.md#mom.
OrthogonalMetricResult mom(const OrthogonalStatistics& subset, Definition definition = Definition::kPaper);

}  // namespace trysquare
