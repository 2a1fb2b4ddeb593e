// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/diagnostic.h"
#include "trysquare/core/execution.h"

#include <string>
#include <string_view>
#include <vector>

/// The only place that writes to the terminal besides the result tables. Results go to stdout, all of this to stderr.
namespace trysquare::app {

enum class ProgressMode { kAuto, kAlways, kNever };

/// True when `stream` (1: stdout, 2: stderr) is a terminal and NO_COLOR is not set.
bool may_use_color(int stream);

void print_error(std::string_view message);
void print_warnings(const std::vector<Diagnostic>& warnings);
void print_note(std::string_view message);

/// A bar on stderr with the stage, the share done and the time left; silent for work of less than half a second.
/// kAuto: only on a terminal. kAlways: also elsewhere, a line now and then, and one when a stage is done.
ProgressCallback progress_bar(ProgressMode mode);

}  // namespace trysquare::app
