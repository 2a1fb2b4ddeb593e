// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trysquare::app {

/// What the command returns to the shell; README.md lists them for users.
enum ExitCode : int { kOk = 0, kUsage = 2, kBadInput = 3, kNotMeaningful = 4, kInternalError = 5 };

/// Thrown by a verb that has done its work but whose numbers mean nothing.
struct NotMeaningful {};

}  // namespace trysquare::app
