// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/dataset/inputs.h"

#include <CLI/CLI.hpp>

namespace trysquare::app {

void add_scan_options(CLI::App& verb, InputOptions& options);
void add_range_options(CLI::App& verb, double& min_range_m, double& max_range_m);
void add_pose_options(CLI::App& verb, InputOptions& options);

}  // namespace trysquare::app
