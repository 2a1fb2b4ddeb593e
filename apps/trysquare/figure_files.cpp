// SPDX-License-Identifier: Apache-2.0
#include "figure_files.h"

#include "trysquare/io/file.h"

#include "outputs.h"
#include "png.h"

#include <filesystem>

namespace trysquare::app {
namespace {

namespace fs = std::filesystem;

/// ".svg" or ".png" when the place is the beginning of file names; empty when it is a folder.
std::string ending_of(const std::string& place) {
  std::error_code ignored;
  const std::string ending = fs::path(place).extension().string();
  return (ending == ".svg" || ending == ".png") && !fs::is_directory(place, ignored) ? ending : "";
}

}  // namespace

void check_place_of_figures(const std::string& place) {
  const std::string ending = ending_of(place);
  if (ending == ".png") require_png_converter();
  if (ending.empty()) {
    require_possible_folder(place);
  } else {
    require_writable_file(place);
  }
}

void write_figures(const std::string& place, const std::vector<Figure>& figures) {
  const std::string ending = ending_of(place);
  if (ending.empty()) make_folder(place);
  for (const Figure& figure : figures) {
    if (ending.empty()) {
      write_file(fs::path(place) / figure.file_name, figure.svg);
      continue;
    }
    fs::path file = fs::path(place).replace_extension();
    file += "_" + fs::path(figure.file_name).replace_extension(ending).string();
    write_file(file, ending == ".png" ? png_of(figure.svg) : figure.svg);
  }
}

}  // namespace trysquare::app
