// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/finding.h"

namespace trysquare {

std::string_view name_of(Severity severity) {
  switch (severity) {
    case Severity::kNote:
      return "note";
    case Severity::kWarning:
      return "warning";
    case Severity::kError:
      break;
  }
  return "error";
}

}  // namespace trysquare
