// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/metrics/definition.h"
#include "trysquare/metrics/orthogonal_metric_result.h"
#include "trysquare/metrics/orthogonal_statistics.h"

namespace trysquare {

/// Orthogonal Mean Map Entropy (OMME): mean entropy, averaged over the directions of an orthogonal subset.
/// In nats; lower is better; compare maps of one scene at one radius only.
///
/// @param subset      Statistics of the orthogonal subset; see orthogonal_statistics().
/// @param definition  kMapMetrics: the sum of the medians, by analogy to MOM. Others: the average of the means.
/// @return            Value in nats. Degenerate neighborhoods are left out and counted.
///
/// Source: Kornilova & Ferrer, "Be your own Benchmark", §IV-A; not in the authors' package.
OrthogonalMetricResult omme(const OrthogonalStatistics& subset, Definition definition = Definition::kPaper);

}  // namespace trysquare
