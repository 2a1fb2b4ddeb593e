// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace trysquare {

/// Whose definition of a metric is meant. docs/definitions.md says where they differ and why.
enum class Definition {
  kPaper,       ///< Kornilova & Ferrer 2021: mean per direction, average over directions. The default.
  kMapMetrics,  ///< The authors' package 0.0.4: median per direction, sum over directions; MME and MPV as in the paper.
  kMapEval,     ///< MapEval's MME: ½ ln(2πe·det Σ), the query excluded, at least ten others. Otherwise as kPaper.
  kAisBonn,     ///< AIS-Bonn's MME: divisor n, any count, undefined points enter the mean as 0. Otherwise as kPaper.
};

/// "paper", "map-metrics", "mapeval", "ais-bonn".
std::string_view name_of(Definition definition);

/// The definition that name_of() calls `name`; nullopt when there is none.
std::optional<Definition> definition_named(std::string_view name);

}  // namespace trysquare
