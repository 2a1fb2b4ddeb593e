// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/evaluation_figures.h"

#include "trysquare/core/error.h"
#include "trysquare/report/internal/charts.h"
#include "trysquare/report/internal/charts_series.h"
#include "trysquare/report/internal/json.h"
#include "trysquare/report/internal/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace trysquare {
namespace {

std::vector<Figure> draw(const internal::Json& evaluation) {
  std::vector<Figure> result;
  const internal::WindowTable table = internal::window_table(evaluation);
  if (!std::any_of(table.series.begin(), table.series.end(), internal::has_value)) return result;
  for (const internal::WindowSeries& series : table.series) {
    if (!internal::has_value(series)) continue;
    const std::optional<internal::Drawing> map = internal::heat_map(evaluation, table.windows, series);
    if (map) result.push_back({"heatmap_" + series.key + ".svg", internal::standalone_svg(*map)});
  }
  result.push_back({"windows.svg", internal::standalone_svg(internal::stacked_window_charts(table))});
  return result;
}

}  // namespace

std::vector<Figure> figures(std::string_view evaluation_json) {
  try {
    return draw(internal::parse(evaluation_json, internal::kEvaluationSchema));
  } catch (const internal::Json::exception& error) {
    throw InvalidArgument(fmt::format("JSON: not as {} says: {}", internal::kEvaluationSchema, error.what()));
  }
}

}  // namespace trysquare
