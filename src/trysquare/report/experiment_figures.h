// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/experiments/experiment.h"
#include "trysquare/report/evaluation_figures.h"

#include <span>
#include <string>
#include <vector>

namespace trysquare {

/// How well the metrics follow the trajectory error, `correlations.svg`: a panel for each group, size of noise and
/// coefficient; in it, for each metric and number of poses, the range over the environments (line), their middle half
/// (box) and their mean (dot).
/// @param correlations  Of every unit, in the order of `units`.
/// @throws InvalidArgument  if their numbers differ or there is nothing to draw.
Figure correlations_figure(std::span<const ExperimentUnit> units,
                           std::span<const std::vector<MetricCorrelation>> correlations);

/// One study, to be drawn.
struct ScatterRow {
  std::string title;  ///< "balanced, 5 poses".
  MetricSamples samples;
};

/// MME, MPV, OMME and MOM over the paper's RPE, `scatter.svg`: one dot a trajectory, a row of panels a study.
/// @throws InvalidArgument  without rows, or if a table lacks a column.
Figure scatter_figure(std::span<const ScatterRow> rows);

}  // namespace trysquare
