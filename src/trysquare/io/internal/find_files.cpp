// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/find_files.h"

#include "trysquare/core/error.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <memory>
#include <string>
#include <system_error>

namespace trysquare::internal {

namespace fs = std::filesystem;

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes a run of digits off the front, and gives it without its leading zeros.
std::string_view take_number(std::string_view& text) {
  std::size_t length = 0;
  while (length < text.size() && is_digit(text[length])) ++length;
  std::string_view number = text.substr(0, length);
  text.remove_prefix(length);
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

void sort_naturally(std::vector<fs::path>& paths) {
  std::sort(paths.begin(), paths.end(),
            [](const fs::path& a, const fs::path& b) { return natural_less(a.native(), b.native()); });
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_directory(status);
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a;
  const std::string_view whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a[0]) && is_digit(b[0])) {
      const std::string_view number_a = take_number(a);
      const std::string_view number_b = take_number(b);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
    } else {
      if (a[0] != b[0]) return static_cast<unsigned char>(a[0]) < static_cast<unsigned char>(b[0]);
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;  // equal but for leading zeros
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> paths;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (!entry->path().filename().native().starts_with('.') && is_file(entry->path())) paths.push_back(entry->path());
  }
  if (error) throw IoError(fmt::format("{}: cannot be listed: {}", folder.string(), error.message()));
  sort_naturally(paths);
  return paths;
}

std::vector<fs::path> files_matching(std::string_view pattern) {
  struct Free {
    void operator()(glob_t* found) const { globfree(found); }
  };
  glob_t found{};
  const int status = glob(std::string(pattern).c_str(), GLOB_NOSORT, nullptr, &found);
  const std::unique_ptr<glob_t, Free> owner(&found);
  std::vector<fs::path> paths;
  for (std::size_t i = 0; status == 0 && i < found.gl_pathc; ++i) {
    if (is_file(found.gl_pathv[i])) paths.emplace_back(found.gl_pathv[i]);
  }
  sort_naturally(paths);
  return paths;
}

std::vector<fs::path> files_named(std::string_view spec) {
  const fs::path literal(spec);
  if (is_file(literal)) return {literal};
  std::error_code ignored;
  if (fs::is_directory(literal, ignored)) throw IoError(fmt::format("{}: it is a directory, expected a file", spec));
  if (std::vector<fs::path> matches = files_matching(spec); !matches.empty()) return matches;
  const std::size_t comma = spec.find(',');
  if (comma == std::string_view::npos) {
    throw IoError(fmt::format("{}: no such file or directory, and no file matches it as a pattern", spec));
  }
  std::vector<fs::path> paths;
  for (std::string_view rest = spec; !rest.empty();) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    const std::string_view part = trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (part.empty()) continue;
    const std::vector<fs::path> found = files_named(part);
    paths.insert(paths.end(), found.begin(), found.end());
  }
  if (paths.empty()) throw IoError(fmt::format("\"{}\": the list names no file", spec));
  return paths;
}

}  // namespace trysquare::internal
