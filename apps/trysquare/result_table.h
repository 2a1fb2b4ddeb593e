// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/pipeline/evaluation.h"
#include "trysquare/report/trajectory_json.h"
#include "trysquare/trajectory/trajectory_errors.h"

#include <string>
#include <string_view>

namespace trysquare::app {

/// The evaluation as a table for the terminal.
/// @param color  With ANSI colors.
std::string evaluation_table(const Evaluation& evaluation, bool color);

/// APE or RPE as a table.
/// @param title  "APE" or "RPE" and what it is about.
std::string errors_table(std::string_view title, const TrajectoryErrors& errors);

/// What was asked for beside RPE as tables; empty when nothing was.
std::string relative_errors_table(const RelativeErrors& others);

}  // namespace trysquare::app
