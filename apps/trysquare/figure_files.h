// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/report/evaluation_figures.h"

#include <string>
#include <vector>

namespace trysquare::app {

/// Help text of an option that takes such a place.
inline constexpr const char* kFiguresHelp =
    "into a folder, as SVG; run.png or run.svg: into files that begin "
    "with run_, as PNG or SVG";

/// Before hours of work: can figures be written there?
/// @throws IoError          if the folder cannot be written to or made.
/// @throws InvalidArgument  if PNG is asked for and nothing here can draw it; says what to install.
void check_place_of_figures(const std::string& place);

/// A folder (made when missing) gets a file for each; `x/run.svg` stands for x/run_<figure>.svg, `x/run.png` for PNG.
/// @throws IoError  if a file cannot be written, or a figure cannot be drawn.
void write_figures(const std::string& place, const std::vector<Figure>& figures);

}  // namespace trysquare::app
