// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trysquare {

/// One figure as the text of a stand-alone SVG file: light, on white, without scripts and fonts of its own.
struct Figure {
  std::string file_name;  ///< "heatmap_mom.svg", "windows.svg", ...
  std::string svg;
};

/// The figures of an evaluation: `heatmap_<metric>.svg` for each of mom, rpe (of a reference), mpv, mme, omme and
/// overlap that has a value in some window, and `windows.svg`, all of them over the scans. The heat maps show the
/// trajectory with one colored segment per window, seen along the map axis of its smallest extent; axes in metres.
/// Empty when there are no windows, or when nothing is defined in any. Same JSON, same bytes.
///
/// @throws InvalidArgument  if the text is no JSON of the schema "trysquare.evaluation/1".
std::vector<Figure> figures(std::string_view evaluation_json);

}  // namespace trysquare
