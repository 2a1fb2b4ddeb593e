// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trysquare {

/// Something a user should know about a result that is not an error. Travels inside the result; nothing is printed.
struct Diagnostic {
  std::string code;     ///< Stable identifier, e.g. "camera_frame", for scripts.
  std::string message;  ///< One or two sentences: what was seen, what it means, what to do.
};

}  // namespace trysquare
