// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trysquare::app {

/// The program that turns SVG into PNG, rsvg-convert of librsvg: run when a PNG is asked for, not linked
/// (docs/decisions/0018-png-by-rsvg-convert.md).
/// @throws InvalidArgument  if it is not in the PATH; says which package has it.
void require_png_converter();

/// An SVG file as a PNG file, two pixels for each of the SVG's.
/// @throws IoError  if the program cannot be run or fails; with what it says.
std::string png_of(const std::string& svg);

}  // namespace trysquare::app
