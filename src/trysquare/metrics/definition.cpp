// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/definition.h"

namespace trysquare {

std::string_view name_of(Definition definition) {
  switch (definition) {
    case Definition::kPaper:
      return "paper";
    case Definition::kMapMetrics:
      return "map-metrics";
    case Definition::kMapEval:
      return "mapeval";
    case Definition::kAisBonn:
      return "ais-bonn";
  }
  return "";
}

std::optional<Definition> definition_named(std::string_view name) {
  for (const Definition definition :
       {Definition::kPaper, Definition::kMapMetrics, Definition::kMapEval, Definition::kAisBonn}) {
    if (name_of(definition) == name) return definition;
  }
  return std::nullopt;
}

}  // namespace trysquare
