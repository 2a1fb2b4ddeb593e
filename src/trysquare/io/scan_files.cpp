// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/scan_files.h"

#include "trysquare/core/error.h"
#include "trysquare/io/file.h"
#include "trysquare/io/internal/find_files.h"
#include "trysquare/io/internal/text.h"
#include "trysquare/io/read_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

namespace trysquare {

namespace fs = std::filesystem;

namespace {

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

std::string ending_of(const fs::path& path) {
  const std::string name = internal::lower_case(path.filename().string());
  return name.ends_with(".pcd.bin") ? ".pcd.bin" : internal::lower_case(path.extension().string());
}

bool may_be_anything(const fs::path& path) {
  const std::string ending = ending_of(path);
  return ending == ".txt" || ending == ".csv";
}

std::vector<fs::path> point_files_in(const fs::path& folder) {
  std::vector<fs::path> paths = internal::files_in(folder);
  const std::size_t num_files = paths.size();
  std::erase_if(paths, [](const fs::path& path) { return !known_point_format(path); });
  if (!std::all_of(paths.begin(), paths.end(), may_be_anything)) std::erase_if(paths, may_be_anything);
  if (paths.empty()) {
    throw IoError(fmt::format("{}: the directory holds no point files ({} other files)", folder.string(), num_files));
  }
  std::set<std::string> endings;
  for (const fs::path& path : paths) endings.insert(ending_of(path));
  if (endings.size() > 1) {
    throw IoError(
        fmt::format("{}: the directory holds point files of several kinds ({}); name one by a pattern such as \"{}\"",
                    folder.string(), fmt::join(endings, " "), (folder / ("*" + *endings.begin())).string()));
  }
  return paths;
}

/// 000017.bin is 17.
std::optional<std::int64_t> number_of(const fs::path& path) { return internal::parse_integer(path.stem().string()); }

std::vector<std::int64_t> read_times(const fs::path& path) {
  const std::string text = read_file(path);
  std::vector<std::int64_t> stamps_ns;
  internal::LineReader lines(text);
  for (std::string_view line; lines.next(line);) {
    const std::string_view token = internal::trimmed(internal::without_comment(line));
    if (token.empty()) continue;
    const std::optional<std::int64_t> stamp_ns = internal::parse_scaled_integer(token, 9);
    if (!stamp_ns) {
      internal::fail_at_line(path.string(), lines.line_number(),
                             fmt::format("found {}, expected a time in seconds", internal::in_quotes(token)));
    }
    stamps_ns.push_back(*stamp_ns);
  }
  return stamps_ns;
}

/// By the number that a file is called, so that a part of a sequence keeps its times; else line by line.
std::vector<std::int64_t> stamps_from_times(const fs::path& times, const std::vector<fs::path>& scans) {
  const std::vector<std::int64_t> all = read_times(times);
  std::vector<std::int64_t> stamps_ns;
  for (const fs::path& scan : scans) {
    const std::int64_t line = number_of(scan).value_or(-1);
    if (line < 0 || line >= static_cast<std::int64_t>(all.size())) break;
    stamps_ns.push_back(all[static_cast<std::size_t>(line)]);
  }
  if (stamps_ns.size() == scans.size()) return stamps_ns;
  if (all.size() == scans.size()) return all;
  throw IoError(fmt::format("{}: found {} times, expected one for each of {} scans; there is none for {}",
                            times.string(), all.size(), scans.size(), scans[stamps_ns.size()].string()));
}

/// The time that a file's name is: nanoseconds with 18 or 19 digits, or seconds with a decimal point.
std::optional<std::int64_t> stamp_in_name(const fs::path& path) {
  std::string stem = path.filename().string();
  stem.resize(stem.size() - ending_of(path).size());
  if (stem.find_first_not_of("0123456789.") != std::string::npos) return std::nullopt;
  const bool seconds = stem.find('.') != std::string::npos;
  if (!seconds && stem.size() != 18 && stem.size() != 19) return std::nullopt;
  return internal::parse_scaled_integer(stem, seconds ? 9 : 0);
}

std::vector<std::int64_t> stamps_from_names(const std::vector<fs::path>& scans) {
  std::vector<std::int64_t> stamps_ns;
  for (const fs::path& scan : scans) {
    const std::optional<std::int64_t> stamp_ns = stamp_in_name(scan);
    if (!stamp_ns) return {};
    stamps_ns.push_back(*stamp_ns);
  }
  return stamps_ns;
}

}  // namespace

std::vector<fs::path> expand_files(std::string_view spec) {
  return is_folder(spec) ? point_files_in(spec) : internal::files_named(spec);
}

std::optional<std::int64_t> number_in_name(const fs::path& path) {
  const std::string stem = path.stem().string();
  const std::size_t last_other = stem.find_last_not_of("0123456789");
  return internal::parse_integer(last_other == std::string::npos ? stem : stem.substr(last_other + 1));
}

ScanFiles::ScanFiles(std::vector<fs::path> paths, std::vector<std::int64_t> stamps_ns)
    : paths_(std::move(paths)), stamps_ns_(std::move(stamps_ns)) {
  if (!stamps_ns_.empty() && stamps_ns_.size() != paths_.size()) {
    throw InvalidArgument(fmt::format("stamps_ns has {} values, expected none or {}, one for each scan",
                                      stamps_ns_.size(), paths_.size()));
  }
}

Scan ScanFiles::load(std::size_t index) const {
  Scan scan = read_scan(paths_.at(index));
  if (!stamps_ns_.empty()) scan.stamp_ns = stamps_ns_[index];
  return scan;
}

std::string ScanFiles::name(std::size_t index) const { return paths_.at(index).string(); }

ScanFiles open_scans(std::string_view spec) {
  if (!is_folder(spec)) {
    std::vector<fs::path> paths = internal::files_named(spec);
    std::vector<std::int64_t> stamps_ns = stamps_from_names(paths);
    return ScanFiles(std::move(paths), std::move(stamps_ns));
  }
  fs::path folder = fs::path(spec).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  if (is_folder(folder / "velodyne")) folder /= "velodyne";
  std::vector<fs::path> paths = point_files_in(folder);
  const fs::path times = folder.parent_path() / "times.txt";
  std::error_code ignored;
  const bool has_times = folder.filename() == "velodyne" && fs::is_regular_file(times, ignored);
  std::vector<std::int64_t> stamps_ns = has_times ? stamps_from_times(times, paths) : stamps_from_names(paths);
  return ScanFiles(std::move(paths), std::move(stamps_ns));
}

}  // namespace trysquare
