// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace trysquare {

/// How bad a finding is.
enum class Severity {
  kNote,     ///< Worth knowing; nothing has to be done.
  kWarning,  ///< Results are worse than they need be.
  kError     ///< Until it is mended metrics mean nothing, or something else than one thinks.
};

/// "note", "warning", "error".
std::string_view name_of(Severity severity);

/// A number that was found and the limit that it is beyond.
struct Evidence {
  double found = 0;
  double limit = 0;
  std::string unit;  ///< "m", "deg", "s", "scans", "patches"; empty: a pure number.
};

/// Something wrong with scans or poses.
struct Finding {
  std::string id;  ///< Stable, for scripts, e.g. "camera_frame"; docs/user/diagnose.md lists them.
  Severity severity = Severity::kWarning;
  std::string message;               ///< What was seen, with the figure and the limit.
  std::string remedy;                ///< What to do.
  std::optional<Evidence> evidence;  ///< Empty: the message holds what there is.
};

}  // namespace trysquare
